use alluvium::{
    InstructionSet, Vector, budget::Account, kernel::*, material::Water, mixture::*, setup,
    simulation::Simulation, time::*,
};
use std::ops::ControlFlow;
fn main() {
    alluvium::parallel::Threads::new(std::env::var("NT").map_or(1, |x| x.parse().unwrap()))
        .unwrap()
        .install(|| run().unwrap())
}
fn run() -> Result<(), Box<dyn std::error::Error>> {
    let a: Vec<String> = std::env::args().collect();
    let dx: f64 = a[1].parse()?;
    let hr: f64 = a[2].parse()?;
    let tend: f64 = a[3].parse()?;
    let wallk = &a[4];
    let mut w = Phase::new(Water::new(1000.0, 25.0)?.with_viscosity(a[6].parse()?)?);
    let p = setup::hydrostatic(1000.0, 9.81, 1, 0.2);
    let (wall, layers) = if wallk == "dyn" {
        (Wall::dynamic(), 3)
    } else {
        (Wall::extrapolated(Slip::FreeSlip), (2.0 * hr).ceil() as usize)
    };
    w.add_wall(
        wall,
        &setup::tank([0.0, 0.0], [0.4, 0.4], dx, layers, [(true, true), (true, false)]),
        dx * dx,
        |_| 0.0,
    )?;
    w.add(&setup::fill([0.0, 0.0], [0.1, 0.2], dx), dx * dx, &p)?;
    println!("{} particles {} walls", w.len(), w.wall_particles());
    let m = Mixture::<f64, 2>::new(WendlandC2::new(hr * dx)?, w)
        .with_gravity(Vector([0.0, -9.81]))
        .with_instruction_set(InstructionSet::at_most("avx512")?);
    let mut s = Simulation::new(m, LeapFrog::new(), StepSize::courant(a[5].parse()?)?);
    s.start()?;
    let b0 = s.budget();
    let e0 = b0.energy();
    let t0 = std::time::Instant::now();
    let mut next = 0.0;
    let r = s.run_until(tend, |s| -> ControlFlow<()> {
        if s.time() >= next { next += tend/8.0;
            let b = s.budget(); let w=s.mixture().water();
            let n=w.wall_particles();
            let front = w.positions()[n..].iter().map(|x|x[0]).fold(0.0,f64::max);
            let (pmin,pmax) = w.pressures()[n..].iter().fold((f64::MAX,f64::MIN),|a,&p|(a.0.min(p),a.1.max(p)));
            let low = w.positions()[n..].iter().map(|x|x[1]).fold(1.0,f64::min)/dx;
            let leak = w.positions()[n..].iter().filter(|x|x[1]<0.0||x[0]<0.0||x[0]>0.4).count();
            let stuck = w.positions()[n..].iter().filter(|x|x[0]<dx && x[1]> 0.01+w.positions()[n..].iter().filter(|y|y[0]>4.0*dx&&y[0]<6.0*dx).map(|y|y[1]).fold(0.0,f64::max)).count();
            print!("low {low:.2} leak {leak} stuck {stuck} ");
            println!("t {:.4} T {:.3} X {:.3} steps {} dt {:.2e} {} E {:.5} Ek {:.4} Ec {:.2e} closure {:.2e} mom {:?} av {:.4} dl {:.4} visc {:.1e} wc {:.4} p {:.0} {:.0} reb {}", s.time(), s.time()*(2.0*9.81/0.1f64).sqrt(), front/0.1, s.steps(), s.last_step().length, s.last_step().limit, b.energy()/e0, b.kinetic/e0, b.compressive/e0, b.closure(&b0)/e0, b.momentum_closure(&b0), b.taken[Account::ArtificialViscosity]/e0,b.taken[Account::DensityDiffusion]/e0,b.taken[Account::Viscosity]/e0,b.taken[Account::WallExtrapolation]/e0, pmin,pmax, s.mixture().neighbourhood().rebuilds());
        }
        ControlFlow::Continue(()) });
    if let Err(e) = r {
        println!("{e}");
    }
    let el = t0.elapsed().as_secs_f64();
    println!(
        "{:.2} s, {:.1} ns/particle-step, {} bytes/particle",
        el,
        el * 1e9 / (s.steps() as f64 * s.mixture().water().len() as f64),
        s.mixture().bytes() / s.mixture().water().len()
    );
    Ok(())
}
