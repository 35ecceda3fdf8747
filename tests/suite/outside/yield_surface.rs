//! A yield surface of one's own, without a closed-form return: a paraboloid.

use alluvium::SymTensor;
use alluvium::driver::{Driver, Kind, Path};
use alluvium::material::{Elasticity, Flow, Material, Plasticity, Soil, SoilMemory, YieldSurface};

/// `F = √(J₂) − √(k (t − I₁/3))`: strength grows with the square root of the pressure; associated.
#[derive(Clone, Debug)]
struct Paraboloid {
    size: f64,
    tension: f64,
}

impl Paraboloid {
    fn strength(&self, stress: &SymTensor<f64>) -> f64 {
        (self.size * (self.tension - stress.trace() / 3.0)).max(0.0).sqrt()
    }
}

impl YieldSurface<f64> for Paraboloid {
    fn excess(&self, stress: &SymTensor<f64>) -> f64 {
        stress.root_j2() - self.strength(stress)
    }
    fn flow(&self, stress: &SymTensor<f64>) -> Flow<f64> {
        let along = stress.deviator() * (0.5 / stress.root_j2());
        let normal = along + SymTensor::isotropic(self.size / (6.0 * self.strength(stress)));
        Flow { normal, direction: normal }
    }
    fn largest_tension(&self) -> f64 {
        self.tension
    }
}

fn rock() -> Soil<f64, Paraboloid> {
    let surface = Paraboloid { size: 2e6, tension: 1e5 };
    Soil::new(2700.0, Elasticity::new(5e9, 0.25).unwrap(), surface).unwrap()
}

/// At a lateral pressure s the axial one is s + q with q² = 3 k (t + s + q/3).
#[test]
fn fails_where_it_says() {
    for plasticity in [Plasticity::ReturnMapping, Plasticity::Rate] {
        let law = rock().with_plasticity(plasticity);
        let start = SoilMemory::geostatic(-1e6, 1.0, 2);
        let mut driver = Driver::new(law, start);
        let rows = driver.run(&Path::new(Kind::TriaxialCompression, 5e-3), 50).unwrap();
        let q = rows[50].shear_stress();
        let exact = 0.5 * 2e6 + (0.25 * 4e12_f64 + 3.0 * 2e6 * (1e5 + 1e6)).sqrt();
        assert!((q / exact - 1.0).abs() < 1e-9, "{plasticity:?}: q = {q}, exact {exact}");
        assert!(rows[50].memory.plastic_strain.trace() > 0.0, "it dilates");
    }
}

#[test]
fn torn_apart_it_is_left_with_its_largest_tension() {
    let (memory, loss) = rock().admit(SoilMemory::stressed(SymTensor::isotropic(1e7)));
    assert_eq!(memory.stress, SymTensor::isotropic(1e5));
    assert!(loss.cut_off > 0.0 && loss.plastic == 0.0);
}
