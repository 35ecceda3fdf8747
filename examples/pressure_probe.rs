//! Pressure at the foot of a dam that breaks, in single precision.

use alluvium::kernel::WendlandC2;
use alluvium::material::Water;
use alluvium::mixture::{Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::StepSize;
use alluvium::{Preset, Vector, setup};
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (dx, preset) = (0.005, Preset::Default);
    let volume = (dx * dx) as f32;
    let still = setup::hydrostatic(1000.0, 9.81, 1, 0.2);
    let mut water = Phase::new(Water::new(1000.0, 25.0)?);
    let walls = setup::tank([0.0; 2], [0.4; 2], dx, 3, [(true, true), (true, false)]);
    water.add_wall(preset.wall(), &walls, volume, &still)?;
    water.add(&setup::fill([0.0; 2], [0.1, 0.2], dx), volume, &still)?;
    let kernel = WendlandC2::new((preset.smoothing_ratio() * dx) as f32)?;
    let mixture = preset.apply(Mixture::<f32, 2>::of_water(kernel, water)).with_gravity(Vector([0.0, -9.81]));
    let mut run = Simulation::new(mixture, preset.leap_frog(), StepSize::courant(preset.courant() as f32)?);
    for k in 0..=8 {
        let _ = run.run_until(0.025 * f64::from(k), |_| ControlFlow::Continue(()))?;
        let foot = run.mixture().probe(&Vector([0.01, 0.01]));
        println!("t = {:.3} s: {:7.1} Pa, kernel filled to {:.2}", run.time(), foot.pressure, foot.support);
    }
    Ok(())
}
