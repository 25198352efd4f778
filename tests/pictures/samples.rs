//! One figure of each kind, with the same data in every field.

use rotordyn::plot::*;

/// Every kind of figure from the given abscissae and ordinates (lengths may differ) and a name.
pub fn all(x: &[f64], y: &[f64], name: &str) -> Vec<Figure> {
    let (x, y, name) = (x.to_vec(), y.to_vec(), name.to_string());
    let pairs: Vec<[f64; 2]> = y.iter().map(|v| [*v, -*v]).collect();
    let first = |k: usize| x.get(k).copied().unwrap_or(f64::NAN);
    let value = |k: usize| y.get(k).copied().unwrap_or(f64::NAN);
    let orders: Vec<OrderLine> = [first(0), 1.0, 7.14, f64::NAN]
        .into_iter()
        .map(|order| OrderLine { label: name.clone(), order, bearing: order > 2.0 })
        .collect();
    let whirls = [Whirl::Forward, Whirl::Backward, Whirl::Torsion, Whirl::Axial, Whirl::Mixed];
    let branches: Vec<Branch> = whirls
        .into_iter()
        .map(|whirl| Branch {
            label: name.clone(),
            whirl: vec![whirl; x.len()],
            rpm: x.clone(),
            hz: y.clone(),
            log_decrement: y.clone(),
        })
        .collect();
    let criticals = vec![Critical { rpm: first(1), hz: value(1), label: name.clone() }];
    let grid: Vec<f64> = x.iter().flat_map(|a| y.iter().map(move |b| a * b)).collect();
    let labelled = |label: &str| label.to_string();
    vec![
        Figure::Campbell(Campbell {
            title: name.clone(),
            note: name.clone(),
            branches: branches.clone(),
            orders: orders.clone(),
            criticals: criticals.clone(),
            max_hz: y.first().copied(),
        }),
        Figure::Spectrogram(Spectrogram {
            title: name.clone(),
            panels: (0..2)
                .map(|_| SpectrogramPanel {
                    name: name.clone(),
                    rpm: x.clone(),
                    hz: y.clone(),
                    level_db: grid.clone().into(),
                    ..Default::default()
                })
                .collect(),
            quantity: labelled("level"),
            unit: labelled("dB re 1 m/s²"),
            span_db: first(2),
            orders: orders.clone(),
            branches,
            ..Default::default()
        }),
        Figure::Waterfall(Waterfall {
            title: name.clone(),
            panels: (0..2)
                .map(|_| WaterfallPanel {
                    name: name.clone(),
                    rpm: x.clone(),
                    hz: y.clone(),
                    amplitude: grid.clone(),
                })
                .collect(),
            unit: labelled("m/s²"),
            orders: orders.clone(),
            ..Default::default()
        }),
        Figure::OrderMap(OrderMap {
            title: name.clone(),
            rpm: x.clone(),
            order: y.clone(),
            level_db: grid.into(),
            span_db: 60.0,
            orders,
            max_order: Some(value(0)),
            ..Default::default()
        }),
        Figure::Frf(Frf {
            title: name.clone(),
            quantity: labelled("receptance"),
            unit: labelled("m/N"),
            curves: vec![FrfCurve {
                label: name.clone(),
                hz: x.clone(),
                re: y.clone(),
                im: y.iter().rev().copied().collect(),
                coherence: y.clone(),
            }],
            ..Default::default()
        }),
        Figure::ModeShapes(ModeShapes {
            title: name.clone(),
            rotor: Rotor {
                z: x.clone(),
                discs: vec![
                    RotorDisc { node: 0, radius: value(0) },
                    RotorDisc { node: 1000, radius: value(1) },
                ],
                supports: x
                    .iter()
                    .map(|z| RotorSupport { z: *z, symbol: SupportSymbol::Joint(JointSymbol::Pin) })
                    .collect(),
                bodies: vec![BodyBox {
                    name: name.clone(),
                    centre: [value(0), value(1), first(0)],
                    half_edges: [[value(0), 0.0, 0.0], [0.0, value(1), 0.0], [0.0, 0.0, first(1)]],
                    to_ground: (true, true),
                }],
                orbit_nodes: vec![0, 1, 1000],
            },
            modes: whirls
                .into_iter()
                .map(|whirl| ModeShape {
                    title: name.clone(),
                    whirl,
                    u_x: pairs.clone(),
                    u_y: pairs.clone(),
                    u_z: pairs.clone(),
                    theta_x: pairs.clone(),
                    theta_y: pairs.clone(),
                    theta_z: pairs.clone(),
                    bodies: pairs.iter().map(|p| BodyMotion { u: [*p; 3], theta: [*p; 3] }).collect(),
                })
                .collect(),
            ..Default::default()
        }),
        Figure::Bode(Bode {
            title: name.clone(),
            unit: labelled("µm"),
            curves: vec![BodeCurve {
                label: name.clone(),
                rpm: x.clone(),
                amplitude: y.clone(),
                phase_deg: y.clone(),
            }],
            criticals,
            ..Default::default()
        }),
        Figure::CursorLines(CursorLines {
            title: name.clone(),
            groups: vec![name.clone(), String::new()],
            panels: vec![
                CursorPanel {
                    label: name.clone(),
                    curves: vec![Curve { label: name.clone(), x: x.clone(), y: y.clone(), points: false }],
                    cursors: vec![
                        Cursor { at: first(1), label: name.clone(), group: 0 },
                        Cursor { at: value(0), label: String::new(), group: 9 },
                    ],
                    found: vec![CursorMark { x: first(1), y: value(1), group: 1 }],
                    ..Default::default()
                };
                2
            ],
            x_range: Some([first(0), first(2)]),
            ..Default::default()
        }),
        Figure::HeatMap(HeatMap {
            title: name.clone(),
            x: x.clone(),
            y: y.clone(),
            value: x.iter().flat_map(|a| y.iter().map(move |b| a - b)).collect(),
            quantity: labelled("kurtosis"),
            y_ticks: vec![(value(0), name.clone())],
            marked: Some(Box::new(MarkedRegion {
                x: [first(0), first(1)],
                y: [value(1), value(0)],
                label: name.clone(),
            })),
            ..Default::default()
        }),
        Figure::Polar(Polar {
            title: name.clone(),
            unit: labelled("µm"),
            curves: vec![PolarCurve {
                label: name.clone(),
                rpm: x.clone(),
                amplitude: y.clone(),
                phase_deg: x.clone(),
            }],
            ..Default::default()
        }),
        Figure::PhasePlanes(PhasePlanes {
            title: name.clone(),
            note: name.clone(),
            planes: vec![
                PhasePlane {
                    title: name.clone(),
                    x_unit: labelled("µm"),
                    equal: true,
                    x: x.clone(),
                    y: y.clone(),
                    filtered_x: y.clone(),
                    filtered_y: x.clone(),
                    keyphasor: vec![0, 7, usize::MAX],
                    section_x: x.clone(),
                    section_y: y.clone(),
                    clearance: Some(value(2)),
                    ..Default::default()
                },
                PhasePlane { section_x: y.clone(), section_y: y.clone(), ..Default::default() },
            ],
        }),
        Figure::Bifurcation(Bifurcation {
            title: name.clone(),
            x_name: name.clone(),
            y_unit: labelled("µm"),
            sweeps: vec![
                SweepPoints {
                    label: name.clone(),
                    x: x.clone(),
                    y: y.clone(),
                    period: x.iter().zip(&y).map(|(x, y)| [*x, *y]).collect(),
                    quasi_periodic: x.clone(),
                    chaotic: y.clone(),
                    undecided: x.clone(),
                    exponent: x.iter().zip(&y).map(|(x, y)| [*x, *y, 0.1 * y]).collect(),
                },
                SweepPoints { x: y.clone(), y: x.clone(), ..Default::default() },
                SweepPoints::default(),
            ],
            ..Default::default()
        }),
        Figure::Sheet(Sheet {
            title: name.clone(),
            note: name.clone(),
            rows: vec![vec![svg::Svg::new(120.0, 80.0); 2]],
        }),
        Figure::Orbits(Orbits {
            title: name.clone(),
            orbits: vec![Orbit {
                title: name.clone(),
                x: x.clone(),
                y: y.clone(),
                filtered_x: y.clone(),
                filtered_y: x.clone(),
                keyphasor: vec![0, 1, usize::MAX],
                clearance: Some(first(1)),
            }],
            ..Default::default()
        }),
        Figure::BallLoads(BallLoads {
            title: name.clone(),
            rows: vec![BallRow {
                title: name.clone(),
                note: name.clone(),
                angle_deg: x.clone(),
                load: y.clone(),
                radial_load: [first(0), first(1)],
            }],
            ..Default::default()
        }),
        Figure::BearingSection(BearingSection {
            title: name.clone(),
            note: name.clone(),
            lines: vec![name.clone()],
            ball_diameter: first(0),
            width: first(1),
            nominal_angle: first(1),
            inner: GrooveSection {
                radius: first(0),
                contact_angle: first(1),
                half_ellipse: 0.1,
                ..Default::default()
            },
            outer: GrooveSection {
                load: first(0),
                shoulder_angle: first(1),
                ring_edge: first(0),
                ..Default::default()
            },
        }),
        Figure::Deflection(Deflection {
            title: name.clone(),
            z: x.clone(),
            u_x: y.clone(),
            u_y: y.iter().rev().copied().collect(),
            stations: x.iter().take(30).map(|z| Mark { label: name.clone(), z: *z }).collect(),
            ..Default::default()
        }),
        Figure::History(History {
            title: name.clone(),
            channels: vec![
                Channel {
                    label: name.clone(),
                    quantity: name.clone(),
                    unit: name.clone(),
                    time: x.clone().into(),
                    value: y.clone().into(),
                    mean: y.iter().rev().copied().collect(),
                    reference: x.clone().into(),
                    second: Some(SecondScale {
                        quantity: name.clone(),
                        unit: name.clone(),
                        offset: 100.0,
                        factor: first(0),
                    }),
                    from_zero: true,
                };
                3
            ],
            legend: std::array::from_fn(|_| name.clone()),
            ..Default::default()
        }),
        lines(&x, &y, &name, false),
        lines(&x, &y, &name, true),
        Figure::Grid(Grid {
            title: name.clone(),
            note: name.clone(),
            x_name: labelled("load"),
            x_unit: labelled("N"),
            legend: vec![name.clone(), labelled("other")],
            columns: 3,
            mark: x.get(1).copied(),
            panels: (0..4)
                .map(|k| GridPanel {
                    name: name.clone(),
                    unit: labelled("N/m"),
                    curves: vec![
                        Curve { label: name.clone(), x: x.clone(), y: y.clone(), points: k == 3 },
                        Curve { x: y.clone(), y: x.clone(), ..Default::default() },
                    ],
                    from_zero: k == 1,
                    log_y: k == 2,
                })
                .collect(),
        }),
        Figure::Stack(Stack {
            title: name.clone(),
            note: name.clone(),
            x_name: labelled("load"),
            x_unit: labelled("N"),
            legend: vec![name.clone(), labelled("other")],
            panels: (0..3)
                .map(|k| StackPanel {
                    name: name.clone(),
                    unit: labelled("N"),
                    curves: vec![
                        Curve { label: name.clone(), x: x.clone(), y: y.clone(), points: false },
                        Curve { x: y.clone(), y: x.clone(), points: true, ..Default::default() },
                    ],
                    log_y: k == 1,
                    from_zero: k == 2,
                    ..Default::default()
                })
                .collect(),
            marks: x.iter().take(30).map(|x| (name.clone(), *x)).collect(),
            height: 120.0,
        }),
        Figure::MachineLayout(MachineLayout {
            title: name.clone(),
            sections: vec![LayoutSection {
                z: [first(0), first(1)],
                outer: [value(0), value(1)],
                inner: [value(1), value(0)],
            }],
            blocks: vec![LayoutBlock {
                label: name.clone(),
                z: [first(0), first(1)],
                y: [value(0), value(1)],
                rotating: true,
            }],
            bearings: vec![LayoutBearing {
                label: name.clone(),
                bore: value(0),
                outside: value(1),
                rows: vec![LayoutRow {
                    z: first(0),
                    width: value(0),
                    pitch: value(0),
                    ball: value(1),
                    contact_angle: value(2),
                }],
            }],
            supports: [
                SupportSymbol::Ball,
                SupportSymbol::SpringDamper { spring: true, damper: true, axial: false },
                SupportSymbol::SpringDamper { spring: true, damper: false, axial: true },
                SupportSymbol::Joint(JointSymbol::Pin),
                SupportSymbol::Joint(JointSymbol::Sleeve),
                SupportSymbol::Joint(JointSymbol::Stop),
            ]
            .map(|symbol| LayoutSupport {
                label: name.clone(),
                z: first(0),
                radius: value(0),
                symbol,
                grounded: true,
            })
            .to_vec(),
            springs: vec![LayoutSpring {
                from: [first(0), value(0)],
                to: [first(1), value(1)],
                spring: true,
                damper: true,
                grounded: true,
            }],
            belts: vec![LayoutBelt {
                label: name.clone(),
                z: first(0),
                radius: value(0),
                pull: [value(0), value(1)],
            }],
            stations: x.iter().take(30).map(|z| (name.clone(), *z)).collect(),
            ..Default::default()
        }),
        Figure::Stabilisation(Stabilisation {
            title: name.clone(),
            note: name.clone(),
            poles: x
                .iter()
                .enumerate()
                .map(|(k, hz)| (*hz, k, if k % 2 == 0 { PoleStability::Stable } else { PoleStability::New }))
                .collect(),
            curves_name: name.clone(),
            hz: x.clone(),
            curves: vec![y.clone(), x.clone()],
            selected: vec![(first(1), false), (first(2), true)],
            dropped: vec![(first(0), name.clone())],
        }),
        Figure::Matrix(Matrix {
            title: name.clone(),
            row_name: name.clone(),
            column_name: name.clone(),
            rows: vec![name.clone(); x.len()],
            columns: vec![name.clone(); y.len()],
            value: x.iter().flat_map(|_| y.iter().map(|v| 0.02 * v)).collect(),
            quantity: name.clone(),
            marked: vec![(0, 0)],
            ..Default::default()
        }),
        Figure::Wireframe(Wireframe {
            title: name.clone(),
            points: x.iter().zip(&y).map(|(x, y)| [*x, *y, 0.0]).collect(),
            strokes: vec![(0..x.len()).collect()],
            shapes: vec![WireShape {
                title: name.clone(),
                motion: y.iter().map(|v| [0.0, 0.0, *v]).collect(),
            }],
            ..Default::default()
        }),
    ]
}

fn lines(x: &[f64], y: &[f64], name: &str, log: bool) -> Figure {
    let curve = |points| Curve { label: name.to_string(), x: x.to_vec(), y: y.to_vec(), points };
    Figure::Lines(Lines {
        title: name.to_string(),
        x_name: "load".to_string(),
        x_unit: "N".to_string(),
        y_name: "stiffness".to_string(),
        y_unit: "N/m".to_string(),
        curves: vec![curve(false), curve(true)],
        log_x: log,
        log_y: log,
        from_zero: !log,
        ..Default::default()
    })
}
