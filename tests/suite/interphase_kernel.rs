//! A kernel of its own between soil and water: that of the mixture changes nothing, one out of all proportion is
//! refused, and every way drag is summed uses it.

use crate::fingerprint::hash;
use alluvium::kernel::{WendlandC2, WendlandC4};
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{Mixture, Phase};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, LeapFrog, StepSize};
use alluvium::{Vector, setup};

type Both = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>;

const SPACING: f64 = 0.05;
const SIDE: f64 = 0.6;
const H: f64 = 1.5 * SPACING;

/// In a box that repeats itself, water that slips at 0.1 m/s through soil on the same lattice.
fn slipping() -> Both {
    let (places, volume) = (setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING), SPACING * SPACING);
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
    soil.add(&places, volume, |_| 0.0).unwrap();
    // Of 0.5 drag would not see the sums: S (1 − φ_s S) is stationary there.
    soil.set_volume_fraction(|_| 0.2);
    let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
    water.add(&places, volume, |_| 0.0).unwrap();
    water.set_velocity(|_| Vector([0.1, 0.02]));
    Mixture::new(WendlandC2::new(H).unwrap(), soil, water)
        .with_periodic(Periodic::new(Vector::zero(), [Some(SIDE); 2]).unwrap())
        .with_drag(Darcy::new(Conductivity::new(0.01).unwrap()))
}

/// With a kernel so narrow between soil and water that on these lattices its sums are percents off those of the other.
fn narrower(mixture: Both) -> Both {
    mixture.with_interphase_kernel(WendlandC4::new(0.7 * H).unwrap()).unwrap()
}

#[test]
fn that_of_the_mixture_changes_no_bit() {
    let bits = |mixture: Both| {
        let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).unwrap());
        (0..20).for_each(|_| _ = run.step().unwrap());
        hash(run.mixture())
    };
    let plain = bits(slipping());
    assert_eq!(bits(slipping().with_interphase_kernel(WendlandC2::new(H).unwrap()).unwrap()), plain);
    assert_ne!(bits(narrower(slipping())), plain);
}

#[test]
fn one_out_of_proportion_is_refused() {
    for (ratio, stands) in [(0.49, false), (0.5, true), (4.0, true), (4.01, false)] {
        let mixture = slipping().with_interphase_kernel(WendlandC2::new(ratio * H).unwrap());
        assert_eq!(mixture.is_ok(), stands, "{ratio}");
    }
}

/// The largest difference of the accelerations over the largest acceleration of the second.
fn apart(a: &Both, b: &Both) -> f64 {
    let (a, b) = (a.water().accelerations(), b.water().accelerations());
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    most(&mut a.iter().zip(b).map(|(a, b)| (*a - *b).norm())) / most(&mut b.iter().map(|b| b.norm()))
}

fn evaluated(mut mixture: Both) -> Both {
    mixture.evaluate().unwrap();
    mixture
}

#[test]
fn drag_of_a_uniform_slip_is_the_same_reconstructed() {
    let plain = evaluated(narrower(slipping()));
    assert!(apart(&evaluated(narrower(slipping()).with_reconstructed_drag()), &plain) < 1e-12);
    assert!(apart(&evaluated(slipping().with_reconstructed_drag()), &plain) > 1e-3);
}

#[cfg(feature = "implicit")]
#[test]
fn drag_solved_over_a_short_step_is_explicit_drag() {
    use alluvium::mixture::DragScheme;
    use alluvium::time::Moment;
    let plain = evaluated(narrower(slipping()));
    let solved = |mixture: Both| {
        let mut mixture = evaluated(mixture.with_drag_scheme(DragScheme::BackwardEuler));
        mixture.complete(Moment::Now, 1e-9).unwrap();
        mixture
    };
    // 1e-9 s is about a millionth of the stopping time.
    assert!(apart(&solved(narrower(slipping())), &plain) < 1e-5);
    assert!(apart(&solved(slipping()), &plain) > 1e-3);
}
