//! A case of soil becomes the particles, the stress and the law it describes.

use crate::case_soil::{CYLINDER, SAND, read};
use alluvium::case::SoilLaw;
use alluvium::kernel::WendlandC2;
use alluvium::material::{AnySurface, Cone, DruckerPrager, Elasticity, Material, MohrCoulomb, YieldSurface};
use alluvium::mixture::{Mixture, Slip, WallKind};
use alluvium::time::LeapFrog;
use alluvium::{Real, SymTensor};

fn mixture<T: Real, const D: usize>(text: &str) -> Mixture<T, D, WendlandC2<T, D>, SoilLaw<T>> {
    let case = read(text).0;
    case.mixture(WendlandC2::new(T::of(case.smoothing_length())).unwrap()).unwrap()
}

#[test]
fn a_column_stands_under_its_own_weight() {
    let case = read(SAND).0;
    let mixture = mixture::<f64, 2>(SAND);
    let (soil, ratio) = (mixture.soil(), case.soil.unwrap().bodies[0].lateral_ratio);
    assert!(mixture.water().is_empty());
    assert_eq!((soil.len() - soil.wall_particles(), soil.walls().len()), (80 * 40, 3));
    assert!(
        soil.walls()
            .iter()
            .all(|wall| { wall.kind() == WallKind::Extrapolated { slip: Slip::NoSlip, suction: false } })
    );
    for i in 0..soil.len() {
        let (x, stress) = (soil.positions()[i], soil.memory(i).stress);
        let vertical = -2650.0 * 9.81 * (0.1 - x[1]);
        let expected = if i >= soil.wall_particles() || (x[0] < 0.2 && x[1] < 0.1) { vertical } else { 0.0 };
        if x[0] < 0.2 && x[1] < 0.1 {
            let SymTensor([xx, yy, zz, xy, yz, xz]) = stress;
            assert!((yy - expected).abs() < 1e-9, "{yy} for {expected} at {:?}", x.0);
            assert!((xx - ratio * yy).abs() < 1e-9 && (zz - xx).abs() < 1e-9);
            assert_eq!([xy, yz, xz], [0.0; 3]);
            assert!(soil.material().surface().excess(&stress) < 0.0, "at rest inside the surface");
        }
        if x[0] > 0.25 {
            assert_eq!(stress, SymTensor::zero(), "a bare wall at {:?}", x.0);
        }
        assert_eq!((soil.density(i), soil.volume_fraction(i)), (2650.0, 1.0));
    }
}

#[test]
fn the_law_is_the_one_the_case_says() {
    let angle = 19.8_f64.to_radians();
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let law = |more: &str| {
        let text = SAND.replacen("friction_angle_deg = 19.8\n", more, 1);
        *mixture::<f64, 2>(&text).soil().material()
    };
    let own = law("friction_angle_deg = 19.8\n");
    assert_eq!((own.reference_density(), own.elasticity()), (2650.0, &elasticity));
    let cone = DruckerPrager::new(Cone::PlaneStrain, angle, 0.0).unwrap();
    assert_eq!(own.surface(), &AnySurface::DruckerPrager(cone));
    let named = law("friction_angle_deg = 19.8\ncohesion_pa = 50.0\ncone = \"triaxial-extension\"\n\
                     tension_cut_off_pa = 3.0\n");
    let cut = DruckerPrager::cohesive(Cone::TriaxialExtension, angle, 0.0, 50.0).unwrap();
    assert_eq!(named.surface(), &AnySurface::DruckerPrager(cut.with_tension_cut_off(3.0).unwrap()));
    let pyramid = law("friction_angle_deg = 19.8\nyield_surface = \"mohr-coulomb\"\n");
    let expected = MohrCoulomb::new(angle, 0.0).unwrap();
    assert_eq!(pyramid.surface(), &AnySurface::MohrCoulomb(expected));
    assert_eq!(law("yield_surface = \"elastic\"\n").surface(), &AnySurface::Unyielding);
    // A chosen surface returns stress as the surface itself does.
    for n in 0..50 {
        let part = |k: i32| f64::from((7 * n + 13 * k * k) % 29 - 14) * 100.0;
        let trial = SymTensor(core::array::from_fn(|k| part(k as i32)));
        let same = |any: &AnySurface<f64>, returned, scaled| {
            assert_eq!(any.returned(&elasticity, &trial), returned);
            assert_eq!(any.scaled_back(&trial), scaled);
        };
        same(own.surface(), cone.returned(&elasticity, &trial), cone.scaled_back(&trial));
        let returned = expected.returned(&elasticity, &trial);
        same(pyramid.surface(), returned, expected.scaled_back(&trial));
    }
}

#[test]
fn a_cylinder_is_round_and_holds_its_mass() {
    let case = read(CYLINDER).0;
    let mixture = mixture::<f32, 3>(CYLINDER);
    let soil = mixture.soil();
    let inner = soil.wall_particles()..soil.len();
    assert_eq!(inner.len() as u64, case.soil_particles());
    let friction = WallKind::Extrapolated { slip: Slip::Friction(0.4), suction: false };
    assert_eq!(soil.walls().iter().map(|wall| wall.kind()).collect::<Vec<_>>(), [friction]);
    let mass: f64 = inner.clone().map(|i| f64::from(soil.masses()[i])).sum();
    let exact = 0.6 * 1600.0 * core::f64::consts::PI * 0.06 * 0.06 * 0.08;
    assert!((mass / exact - 1.0).abs() < 0.02, "{mass} kg for {exact} kg");
    for i in inner {
        let (x, memory) = (soil.positions()[i], soil.memory(i));
        assert!((x[0] - 0.1).hypot(x[2] - 0.1) < 0.0601, "{:?}", x.0);
        // The stress is per area of the grains: it does not know the volume fraction.
        let vertical = -1600.0 * 9.81 * (0.08 - x[1]);
        assert!((memory.stress.0[1] - vertical).abs() < 0.1, "{:?}", memory.stress.0);
        assert!((soil.volume_fraction(i) - 0.6).abs() < 1e-6);
    }
}

#[test]
fn stress_follows_a_gravity_that_is_tilted() {
    let (text, ratio) = (SAND.replacen("end_time_s", "gravity_m_per_s2 = [6.0, -8.0]\nend_time_s", 1), 0.5);
    let text = text.replacen("[tank]", "lateral_stress_ratio = 0.5\n[tank]", 1);
    let mixture = mixture::<f64, 2>(&text);
    let soil = mixture.soil();
    // The highest corner against gravity is (0, 0.1).
    for i in soil.wall_particles()..soil.len() {
        let x = soil.positions()[i];
        let vertical = -2650.0 * (6.0 * x[0] - 8.0 * (x[1] - 0.1));
        let SymTensor([xx, yy, zz, xy, ..]) = soil.memory(i).stress;
        let along = 0.36 * xx + 0.64 * yy - 2.0 * 0.48 * xy;
        assert!((along - vertical).abs() < 1e-9 && (zz - ratio * vertical).abs() < 1e-9);
    }
}

#[test]
fn soil_of_every_surface_runs() {
    let coarse = SAND.replacen("0.0025", "0.01", 1);
    let surfaces =
        ["friction_angle_deg = 19.8\n", "friction_angle_deg = 19.8\nyield_surface = \"mohr-coulomb\"\n"];
    for (surface, preset) in
        surfaces.into_iter().flat_map(|surface| [(surface, ""), (surface, "preset = \"paper\"\n")])
    {
        let case = read(&format!("{preset}{}", coarse.replacen(surfaces[0], surface, 1))).0;
        let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).unwrap();
        let mut run = case.simulation(kernel, LeapFrog::new()).unwrap();
        for _ in 0..20 {
            run.step().unwrap();
        }
        let soil = run.mixture().soil();
        assert!(soil.velocities()[soil.wall_particles()..].iter().all(|v| v.norm() < 0.1));
    }
}
