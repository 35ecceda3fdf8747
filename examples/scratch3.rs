use alluvium::{
    Real, Vector, kernel::*, material::Water, mixture::*, setup, simulation::Simulation, time::*,
};
use std::ops::ControlFlow;
fn go<T: Real>()
where
    WendlandC2<T, 3>: Kernel<T, 3>,
{
    let dx = 0.01f64;
    let o = T::of;
    let mut w = Phase::<T, 3, _>::new(Water::new(o(1000.0), o(30.0)).unwrap());
    let p = setup::hydrostatic(o(1000.0), o(9.81), 1, o(0.2));
    w.add_wall(
        Wall::extrapolated(Slip::FreeSlip),
        &setup::tank([0.0, 0.0, 0.0], [0.4, 0.3, 0.1], dx, 3, [(true, true), (true, false), (true, true)]),
        o(dx * dx * dx),
        |_| o(0.0),
    )
    .unwrap();
    w.add(&setup::fill([0.0, 0.0, 0.0], [0.1, 0.2, 0.1], dx), o(dx * dx * dx), &p).unwrap();
    println!("{} {} particles {} walls", T::NAME, w.len(), w.wall_particles());
    let m = Mixture::<T, 3>::new(WendlandC2::new(o(1.3 * dx)).unwrap(), w)
        .with_gravity(Vector::of([0.0, -9.81, 0.0]));
    let mut s = Simulation::new(m, LeapFrog::new(), StepSize::courant(o(0.2)).unwrap());
    s.start().unwrap();
    let b0 = s.budget();
    let mut next = 0.0;
    let r = s.run_until(0.15, |s| -> ControlFlow<()> {
        if s.time() >= next {
            next += 0.05;
            let b = s.budget();
            let n = s.mixture().water().wall_particles();
            let front =
                s.mixture().water().positions()[n..].iter().map(|x| x[0].as_f64()).fold(0.0, f64::max);
            println!(
                "t {:.3} front {:.4} closure {:.2e} mom {:?} E {:.4} Ek {:.4} {:?}",
                s.time(),
                front / 0.1,
                b.closure(&b0) / b0.energy(),
                b.momentum_closure(&b0),
                b.energy() / b0.energy(),
                b.kinetic / b0.energy(),
                s.last_step()
            );
        }
        ControlFlow::Continue(())
    });
    if let Err(e) = r {
        println!("{e}");
    }
}
fn main() {
    alluvium::parallel::Threads::new(1).unwrap().install(|| {
        go::<f64>();
        go::<f32>();
    })
}
