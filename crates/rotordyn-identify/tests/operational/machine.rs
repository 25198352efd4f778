//! A synthetic machine: known modes under independent random forces at all points, sensors with noise.

use std::f64::consts::{PI, TAU};

use rotordyn_identify::operational::OutputRecord;
use rotordyn_signal::Quantity;
use rotordyn_signal::record::Dof;

/// Gaussian numbers of a seed (splitmix64, Box-Muller).
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Self {
        Noise(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x1234_5678_9ABC_DEF1)
    }

    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn next(&mut self) -> f64 {
        let (a, b) = (self.uniform().max(1e-300), self.uniform());
        (-2.0 * a.ln()).sqrt() * (TAU * b).cos()
    }
}

#[derive(Clone, Debug)]
pub struct Machine {
    /// Undamped natural frequency [Hz], damping ratio, real shape.
    pub modes: Vec<(f64, f64, Vec<f64>)>,
    pub rate: f64,
    pub duration: f64,
    /// RMS of white sensor noise over that of a channel.
    pub sensor_noise: f64,
    /// Pole of the AR(1) filter of the forces; 0 is white.
    pub colour: f64,
    /// Displacements at the first points, velocities at the others.
    pub displacements: usize,
}

/// Bending shape k of a beam at n points.
pub fn shape(k: usize, n: usize) -> Vec<f64> {
    (0..n).map(|p| (k as f64 * PI * (p as f64 + 0.7) / (n as f64 + 0.4)).sin()).collect()
}

impl Machine {
    pub fn new(modes: &[(f64, f64)], channels: usize, rate: f64, duration: f64) -> Self {
        let list = modes.iter().enumerate().map(|(k, &(hz, zeta))| (hz, zeta, shape(k + 1, channels)));
        Machine { modes: list.collect(), rate, duration, sensor_noise: 0.05, colour: 0.0, displacements: 0 }
    }

    /// Damped frequency of a mode [Hz].
    pub fn hz(&self, k: usize) -> f64 {
        let (hz, zeta, _) = &self.modes[k];
        hz * (1.0 - zeta * zeta).sqrt()
    }

    pub fn samples(&self) -> usize {
        (self.rate * self.duration) as usize
    }

    /// Motion at all points. Each mode is integrated exactly for forces that are constant within a sample, so that its
    /// poles are those of the machine.
    pub fn record(&self, seed: u64) -> OutputRecord {
        let mut noise = Noise::new(seed);
        let channels = self.modes[0].2.len();
        let dt = 1.0 / self.rate;
        // x = (q, q̇): x₊ = Φ x + Γ f.
        let step: Vec<([f64; 4], [f64; 2])> = self
            .modes
            .iter()
            .map(|(hz, zeta, _)| {
                let w = TAU * hz;
                let (a, wd) = (zeta * w, w * (1.0 - zeta * zeta).sqrt());
                let (e, c, s) = ((-a * dt).exp(), (wd * dt).cos(), (wd * dt).sin());
                let phi = [e * (c + a / wd * s), e * s / wd, -e * w * w / wd * s, e * (c - a / wd * s)];
                (phi, [(1.0 - phi[0]) / (w * w), phi[1]])
            })
            .collect();
        let warm = self.modes.iter().map(|(hz, zeta, _)| 6.0 / (TAU * hz * zeta)).fold(0.0, f64::max);
        let (warm, count) = ((warm * self.rate) as usize, self.samples());
        let mut state = vec![[0.0; 2]; self.modes.len()];
        let mut force = vec![0.0; channels];
        let mut samples = vec![Vec::with_capacity(count); channels];
        for k in 0..warm + count {
            force.iter_mut().for_each(|f| *f = self.colour * *f + noise.next());
            for ((x, (phi, gamma)), (_, _, shape)) in state.iter_mut().zip(&step).zip(&self.modes) {
                let f: f64 = shape.iter().zip(&force).map(|(a, b)| a * b).sum();
                *x = [
                    phi[0] * x[0] + phi[1] * x[1] + gamma[0] * f,
                    phi[2] * x[0] + phi[3] * x[1] + gamma[1] * f,
                ];
            }
            if k >= warm {
                for (p, channel) in samples.iter_mut().enumerate() {
                    let derivative = usize::from(p >= self.displacements);
                    let modes = state.iter().zip(&self.modes);
                    channel.push(modes.map(|(x, (_, _, shape))| x[derivative] * shape[p]).sum());
                }
            }
        }
        for channel in &mut samples {
            let rms = rms(channel);
            channel.iter_mut().for_each(|x| *x += self.sensor_noise * rms * noise.next());
        }
        OutputRecord {
            samples,
            sample_rate: self.rate,
            dofs: (0..channels).map(|k| Dof::new(k as i64 + 1, 2)).collect(),
            quantities: (0..channels)
                .map(|p| if p < self.displacements { Quantity::Displacement } else { Quantity::Velocity })
                .collect(),
        }
    }
}

pub fn rms(channel: &[f64]) -> f64 {
    (channel.iter().map(|x| x * x).sum::<f64>() / channel.len() as f64).sqrt()
}

/// Adds sines of the shaft angle to all channels: order, amplitude over the RMS of the channel.
pub fn add_orders(record: &mut OutputRecord, theta: &[f64], orders: &[(f64, f64)]) {
    for (c, channel) in record.samples.iter_mut().enumerate() {
        let size = rms(channel);
        for (order, amplitude) in orders {
            let phase = 0.7 * order + 0.4 * c as f64;
            for (x, theta) in channel.iter_mut().zip(theta) {
                *x += amplitude * size * (order * theta + phase).cos();
            }
        }
    }
}
