//! A drop in free fall: it falls as Galilei says, and keeps its shape and its momentum.

use alluvium::kernel::WendlandC2;
use alluvium::material::Water;
use alluvium::mixture::{Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::{Vector, setup};
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dx = 0.002;
    let disc = setup::fill([-0.02; 2], [0.02; 2], dx).into_iter().filter(|x| x.norm() < 0.02);
    let mut drop = Phase::new(Water::new(1000.0, 20.0)?);
    drop.add(&disc.collect::<Vec<_>>(), dx * dx, |_| 0.0)?;
    let mixture =
        Mixture::<f64, 2>::of_water(WendlandC2::new(1.3 * dx)?, drop).with_gravity(Vector([0.0, -9.81]));
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), StepSize::courant(0.2)?);
    let _ = run.run_until(0.2, |_| ControlFlow::Continue(()))?;
    let water = run.mixture().water();
    let (lowest, highest) = water
        .positions()
        .iter()
        .fold((f64::INFINITY, -f64::INFINITY), |(a, b), x| (a.min(x[1]), b.max(x[1])));
    println!("after {:.1} s: centre at {:.5} m", run.time(), 0.5 * (lowest + highest));
    println!("Galilei:       centre at {:.5} m", -0.5 * 9.81 * run.time().powi(2));
    println!("height {:.5} m, momentum not explained {:?} kg m/s", highest - lowest, {
        let budget = run.budget();
        [budget.momentum[0], budget.momentum[1] + budget.mass * 9.81 * run.time()]
    });
    Ok(())
}
