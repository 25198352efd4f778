//! All codes of warnings: name, severity, when it is given, what to do.

use super::Severity::{self, Caution, Serious};
use serde::{Deserialize, Serialize};

/// Declares every code once.
macro_rules! codes {
    ($($code:ident, $name:literal, $severity:ident, $when:literal, $advice:literal;)*) => {
        /// Kind of a warning; its name never changes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        pub enum Code {
            $(#[doc = $when] $code,)*
        }

        impl Code {
            /// Every code, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$code),*];

            /// Name in output and in `rotordyn help NAME`.
            pub fn name(self) -> &'static str {
                match self { $(Self::$code => $name),* }
            }

            pub fn severity(self) -> Severity {
                match self { $(Self::$code => $severity),* }
            }

            /// When the warning is given, and why it matters.
            pub fn when(self) -> &'static str {
                match self { $(Self::$code => $when),* }
            }

            /// What to do in general.
            pub fn advice(self) -> &'static str {
                match self { $(Self::$code => $advice),* }
            }
        }
    };
}

codes! {
    // Input
    MaterialRange, "material-range", Serious,
        "Modulus and density are not those of an engineering material, alone or together (speed of sound in a bar). A power \
         of ten in the modulus moves every natural frequency by a factor of 3.2.",
        "check the unit of the value; a massless or rigid part is better stated as such (an added mass, a rigid rotor)";
    SectionStep, "section-step", Serious,
        "The diameter of the shaft changes by a factor of more than 30 from one section to the next: usually a slip of the \
         unit.",
        "check the units of the diameters";
    BoreMismatch, "bore-mismatch", Serious,
        "The bore of a bearing, stated or of its designation, differs from the diameter of the shaft at its seat by more than \
         10 %.",
        "choose the bearing of the seat's size, or the diameter of the section under it";
    DiscFit, "disc-fit", Serious,
        "The bore of a disc by dimensions is more than 25 % larger than the shaft in it, or its outer diameter less than that of \
         the shaft. A disc where the shaft has no element, or on another disc, is not compared.",
        "check the units of the diameters, or the diameter of the section under it";
    DiscSize, "disc-size", Serious,
        "A disc by dimensions is larger than the machine: a diameter of more than five, or a thickness of more than two lengths \
         of the shaft; or an inertia beside a mass is that of a ring so large, or of one far thinner than the shaft. Its inertia \
         makes modes at almost 0 Hz.",
        "check the unit of diameter and thickness, or of the inertia";
    Gravity, "gravity", Caution,
        "The acceleration of gravity is far from that of the earth, or points along +y.",
        "check its unit and sign: one value is downwards, along -y; 0 m/s^2 is without gravity";
    OverlappingDiscs, "overlapping-discs", Serious,
        "Two discs of stated width occupy the same length of the shaft: usually one disc given twice.",
        "check stations and widths, or state one disc with the sum of both masses";
    DiscCollision, "disc-collision", Serious,
        "A disc and a bearing with its housing occupy the same length of the shaft, and the disc is larger than the \
         bearing's bore.",
        "check the stations of disc and bearing, and the width of the disc";
    SingleBearing, "single-bearing", Caution,
        "The rotor is held radially at one place only; tilting is resisted by that bearing alone.",
        "add the second bearing, or confirm that the bearing resists tilting";
    BearingSpeed, "bearing-speed", Caution,
        "The speed factor n d_m of a ball bearing lies above what its kind is built for: 1.5e6 mm rpm for deep groove, \
         2.5e6 for angular contact bearings.",
        "check the speed, or choose a smaller or a spindle bearing";
    BalanceQuality, "balance-quality", Caution,
        "The unbalance of the rotor over its mass, times the highest speed, is above 100 mm/s: worse than the grade \
         G 100 of ISO 21940-11, which no machine on rolling bearings is delivered with.",
        "check the unit of the unbalance: 1 g mm is 1e-6 kg m";
    CageSpeed, "cage-speed", Caution,
        "The stated speed of a cage is not that of a cage that its balls carry along: these roll on both races, at half the shaft \
         speed at most on an outer ring at rest.",
        "check the ratio: cage speed over shaft speed, FTF in orders; or leave `cage` out, which takes that of rolling balls";
    OverlappingBearings, "overlapping-bearings", Serious,
        "Two ball bearings occupy the same length of the shaft: usually one bearing given twice, or a wrong station.",
        "check the stations; one bearing with arrangement describes a pair";
    UnusedItem, "unused-item", Caution,
        "A material, lubricant or other item of the file is used by nothing: often a misspelt name elsewhere.",
        "remove it, or refer to it where it was meant";
    DefectGeometry, "defect-geometry", Caution,
        "A defect of a bearing is wider than one contact, much narrower than a loaded contact, or deeper than a ball can reach.",
        "check width and depth of the defect";
    LeftOut, "left-out", Caution,
        "Part of a file was not read: links that lead nowhere or to other files, types that are neither numbers nor texts, \
         damaged or oversized data. All the rest was read.",
        "see the text of the warning; where the part is needed, write the file again with plain arrays";
    NotImported, "not-imported", Caution,
        "Part of a file of another program has no counterpart in the model file written from it, or means something else there.",
        "see the text of the warning; add what matters by hand";
    MeasuredSpeed, "measured-speed", Caution,
        "A measured speed curve is changed or extended to be followed.",
        "look at the curve of the record";
    // Equilibrium
    FreeMotion, "free-motion", Serious,
        "Nothing constrains a motion of the machine: it has a rigid-body mode at 0 Hz, and static loads in its direction \
         have no equilibrium. A bearing without load constrains nothing.",
        "add a bearing, joint or bushing that holds this motion, or preload the bearing that should";
    FreeAxialMotion, "free-axial-motion", Caution,
        "Nothing constrains the shaft axially, as with bearings that have radial stiffness only: bending modes and responses \
         do not depend on it, but axial loads have no equilibrium.",
        "state k_zz of one bearing, or add a thrust bearing";
    BearingUnloaded, "bearing-unloaded", Serious,
        "A bearing or a row of it carries nothing at the operating point: its stiffness is zero, and modes, FRFs and \
         unbalance responses are those of a machine without it.",
        "preload it, reduce its clearance, or state the load that it has";
    FittedLaw, "fitted-law", Caution,
        "Ball loads lie outside the range to which the power law of a contact was fitted.",
        "fit the law to the loads that occur, or use contact = \"hertz\"";
    StaticLoad, "static-load", Serious,
        "Balls are pressed beyond the static load rating (4.2 GPa, ISO 76): the races are dented, and the elastic contact \
         does not hold.",
        "check load and preload, or choose a larger bearing";
    Shoulder, "shoulder", Caution,
        "The contact ellipse of a ball reaches beyond the shoulder of its groove.",
        "check axial load and preload, or choose a bearing with higher shoulders";
    Film, "film", Caution,
        "The lubricant film is thinner than the roughness: asperities touch, and film stiffness and friction do not hold.",
        "choose a lubricant of higher viscosity, or check temperature and roughness";
    ContactAngleLost, "contact-angle-lost", Serious,
        "A single-row angular contact bearing or a tandem pair slides axially until its balls carry at less than half of their angle: \
         nothing holds the shaft axially against its direction.",
        "preload it against a second bearing";
    OpenSide, "open-side", Serious,
        "Balls are pressed onto the open side of an angular contact bearing.",
        "turn the bearing round, or preload it";
    NotChecked, "not-checked", Serious,
        "The supports could not be checked, as the machine has no equilibrium at a speed of the study.",
        "see the text of the warning";
    MinimumLoad, "minimum-load", Caution,
        "The load is below the minimum load of a ball bearing at this speed: balls and cage may skid.",
        "preload the bearing, or see the slip with model = \"free_ball\"";
    GyroscopicSliding, "gyroscopic-sliding", Caution,
        "The gyroscopic moment of the balls needs more friction than the contacts have: the balls slide.",
        "raise the axial preload, or lower the speed";
    LooseRing, "loose-ring", Caution,
        "At speed the bore of an inner ring grows by more than its interference on the shaft: it has play and creeps, and the \
         bearing is not held as the model has it.",
        "raise shaft_interference, or lower the speed";
    PreloadWithoutEffect, "preload-without-effect", Serious,
        "A rigid preload is stated for a bearing whose inner ring is free to move axially under its load: the ring moves until \
         the balls carry that load alone, whatever the preload.",
        "hold u_z (`constrained`), state the load without its axial part, or take a spring preload";
    BallInertia, "ball-inertia", Caution,
        "Balls are taken as massless although their centrifugal force changes contact angles and stiffness.",
        "use ball_inertia = \"auto\"";
    Rating, "rating", Caution,
        "Rating life or static rating are outside the range of ISO 281, ISO 76 or ISO/TS 16281.",
        "take lives and ratings as orders of magnitude only";
    DefectsAveraged, "defects-averaged", Caution,
        "A result averaged over the cage angle leaves out the defects of the bearing.",
        "compute it at a fixed cage angle";
    LubricantFilm, "lubricant-film", Caution,
        "The film of a contact could not be computed as asked.",
        "see the text of the warning";
    TableRange, "table-range", Caution,
        "A study needs speeds beyond the table of a bearing or motor; the last value holds there.",
        "extend the table, or refuse such speeds with beyond_table = \"refuse\"";
    LargeDeflection, "large-deflection", Caution,
        "The shaft bends so far that linear theory of beams does not hold: sections rotate by more than 0.1 rad, or bending strains \
         exceed 0.5 %, 1 GPa in steel.",
        "check loads, diameters and units; of an unbalance response also its damping and the unbalance";
    BeltPull, "belt-pull", Serious,
        "A belt loses much of its stated pull at equilibrium, or goes slack: a belt cannot push.",
        "if the stated pull is that of the machine at rest, set constant_pull = true";
    Preload, "preload", Caution,
        "A bearing carries less axial force in the machine than its preload states.",
        "state the preload as mounted_force, or preload the opposite bearing too";
    // Linear studies
    UnstableMode, "unstable-mode", Serious,
        "A mode has negative damping at a speed of the study: the machine vibrates by itself, and a steady response does \
         not exist.",
        "find the cause (internal damping, cross-coupled stiffness), or stay below the threshold of stability";
    StaticInstability, "static-instability", Serious,
        "A motion of the machine grows without oscillation: its stiffness is negative, by a coefficient of a support or an \
         axial force beyond the buckling load. The equilibrium is not one that the machine stays in, the motion is not among \
         the modes, and steady responses do not exist.",
        "check signs and units of stiffness coefficients and of the axial force";
    UndampedPeak, "undamped-peak", Caution,
        "A mode in the range of the response has no damping: the response is infinite there; or so little (amplification factor \
         above 50000) that the height of its peak says nothing.",
        "state damping: [damping] modal, or damping of supports";
    MarginRange, "margin-range", Caution,
        "A critical speed lies so near the operating speeds that API 617 may ask for more distance, but outside the speeds of the \
         unbalance response: the table of separation margins does not have it.",
        "extend the speeds of the response to it: --max-speed, study.unbalance.speeds; from 16 % below the operating speeds to \
         26 % above them none is missed";
    LinearRange, "linear-range", Serious,
        "A linear response moves a bearing by more than its clearance, or loads it with more than its static load: its \
         contacts open, and its stiffness is another.",
        "use a run-up, which has the bearing's own forces, or a smaller unbalance or force";
    MeshLimit, "mesh-limit", Caution,
        "A mode is shorter than the elements of the shaft can carry: fewer than four elements in half a wave.",
        "refine the shaft: more elements, shaft.max_element_length";
    WhirlFrequency, "whirl-frequency", Caution,
        "Modes take coefficients of a bearing over whirl frequency at the frequency of rotation; with those at its own \
         frequency a mode is another.",
        "use the values that the warning gives, or an FRF, which takes the coefficients at each of its frequencies";
    CrossingUncertain, "crossing-uncertain", Caution,
        "Critical speeds may be missing in a range where bearings change faster with speed than the search follows.",
        "compute a Campbell diagram with more speeds there";
    BranchLost, "branch-lost", Caution,
        "A branch of the Campbell diagram cannot be followed by its shape.",
        "use more speeds in the range named";
    BranchLabel, "branch-label", Caution,
        "The shape of a mode changes along its branch so that it has another name at the end.",
        "look at the shape at the speed of interest, not at the label alone";
    LowMac, "low-mac", Caution,
        "A measured and a computed mode are paired although their shapes agree poorly (MAC below 0.5) or their frequencies \
         differ by more than 20 %.",
        "measure at more points, or restrict the pairs";
    FrfLevel, "frf-level", Caution,
        "Measured FRFs differ from the computed ones by a factor, a sign, a power of the frequency or an exchange of points that \
         wrong units, a sensor or its place explain, not the model.",
        "check unit, calibration, direction and point of what the warning names";
    // Runs
    EnergyBalance, "energy-balance", Serious,
        "The energies of a run do not balance: the time step is too long for the forces.",
        "reduce the time step";
    TimeStep, "time-step", Caution,
        "The time step changes a level that is shown.",
        "reduce the time step as the warning says";
    Reduction, "reduction", Caution,
        "Natural frequencies of the reduced model differ from those of the full one.",
        "raise study.run_up.cutoff";
    SampleRate, "sample-rate", Caution,
        "An order line that is asked for lies above half the sampling rate at the highest speed.",
        "raise study.run_up.sample_rate, or ask for lower orders";
    OrderSmear, "order-smear", Caution,
        "The speed changes so much within a window of a spectrogram that an order line is more than twice as wide as a shorter \
         window would show it, and too low; or the amplitude of an order changes so much within a window of the order tracking, or \
         within the response of a Vold-Kalman filter, that the maximum of its cut is too low.",
        "shorten study.spectrogram.length, or see the order cuts of [study.orders], which follow the shaft angle; of a cut, \
         shorten the window (resolution, --resolution, --order-resolution) or widen --bandwidth";
    OrdersInOneBand, "orders-in-one-band", Caution,
        "Two orders that the Vold-Kalman filter tracks lie in one pass band: their amplitudes are told apart only as far as \
         they change more slowly than the two beat. Or what an order cut or track reads is the line of another order beside it.",
        "narrow study.orders.bandwidth (or --bandwidth), as far as the amplitudes change slowly enough for it, or track one of the two; \
         for a cut, a finer --order-resolution";
    TachoJitter, "tacho-jitter", Caution,
        "A tracked order lies beside a stronger one which the jitter of the tacho pulses modulates: part of what is read there is \
         the stronger order's. Or jitter, as of a coarsely sampled tacho, lowers an order, the pulses are aliased, or the marks are \
         uneven or more than stated.",
        "sample the tacho channel faster, use more pulses per revolution, or narrow --bandwidth";
    FreeBalls, "free-balls", Caution,
        "A study of balls and cage as free bodies, or their comparison with a kinematic cage, could not be computed.",
        "see the text of the warning";
    LongComputation, "long-computation", Caution,
        "The computation takes long by the forecast of its steps or points.",
        "change what the warning names, or let it run";
    NotSettled, "not-settled", Caution,
        "A motion has not settled within the transient allowed.",
        "raise transient_limit";
    SweepIncomplete, "sweep-incomplete", Caution,
        "A sweep ends where a point has no equilibrium.",
        "restrict the sweep to the loads and speeds that the bearing carries";
    IncompleteRun, "incomplete-run", Serious,
        "A stored run ended before its end.",
        "repeat the run";
    // Measured data
    MeasuredData, "measured-data", Caution,
        "A measured file is not complete or not consistent: channels are left out, or a unit or rate is assumed.",
        "state what is missing in a mapping";
    ClippedRecord, "clipped-record", Caution,
        "Samples of a measured channel stand at a limit again and again: its levels are too low, and harmonics appear that the \
         machine does not have.",
        "measure with a larger range of the sensor or the recorder";
    DeadChannel, "dead-channel", Serious,
        "A measured channel has one value over the whole record: the sensor is dead, not connected or not supplied. It says \
         nothing of the machine.",
        "check sensor, cable and supply, or choose another channel with --channel";
    RecordGap, "record-gap", Serious,
        "A measured channel stands at one value for many samples: the sensor or the recorder was interrupted. Levels are too \
         low, and the steps at the ends of the gap excite the whole spectrum.",
        "restrict the record to one side of the gap with --time, or measure again";
    RecordSpike, "record-spike", Caution,
        "Single samples of a measured channel, or samples of one value, are far from all others: an error of transmission, a loose \
         contact, or a value that stands for missing samples. They govern peak, kurtosis and the spectrum at high frequencies.",
        "restrict the record with --time so that it is without them, or measure again";
    Identification, "identification", Caution,
        "Identified poles or shapes rest on hits that are left out or truncated, or on FRFs that are noisy, few or poorly fitted.",
        "see the text of the warning";
    ModelUpdate, "model-update", Caution,
        "An update has correlated or bounded parameters, did not converge, or its data and priors are inconsistent.",
        "free fewer parameters, or measure more";
    LackOfFit, "lack-of-fit", Serious,
        "The updated model does not explain the measurement: differences as large as those left have a probability below 1 % \
         (chi^2 with its degrees of freedom). The fitted values stand for an error of the model elsewhere.",
        "free a parameter that is named to explain the misfit, and check mode pairs, mapping, signs and units";
    ShaftSpeedNotFound, "shaft-speed-not-found", Caution,
        "A record has no family of shaft harmonics near the stated speed; bearing lines are multiples of the speed.",
        "check speed and sampling rate, or widen --speed-range";
    BearingOrdersInconsistent, "bearing-orders-inconsistent", Caution,
        "Given orders BPFO and BPFI do not add up to a whole number of balls.",
        "check the orders: those of another bearing or rounded ones move every line";
    RecordsDiffer, "records-differ", Caution,
        "The records of a trend have different sampling rates, durations, channels or units: what changes between them may be \
         the measurement, not the machine.",
        "compare records of one setting, or restrict them with --channel and --time";
    SignalAnalysis, "signal-analysis", Caution,
        "An analysis of a record was left out, or needs what the record does not contain.",
        "see the text of the warning";
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_unique_and_in_kebab_case() {
        let names: BTreeSet<&str> = Code::ALL.iter().map(|code| code.name()).collect();
        assert_eq!(names.len(), Code::ALL.len());
        assert!(names.iter().all(|name| name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-')));
    }
}
