//! Soil laws along paths of strain and stress: every closed form, in both precisions.

use crate::driver_laws::{Mistake, Mistaken, Slip, Slipped};
use alluvium::driver::{Control, Driver, Kind, Leg, Path, Row};
use alluvium::material::{
    Cone, DruckerPrager, Elasticity, Material, MohrCoulomb, Plasticity, Soil, SoilMemory, YieldSurface,
};
use alluvium::verify::{Conditions, Expected, Measured, Random, Study};
use alluvium::{Real, SymTensor};

const CLOSED: &str = "closed form of the cone's equations, derived by hand";
const OTHER_CONE: &str = "α of another cone";
const DENOMINATOR: &str = "associated denominator with ψ = 0";
const PLANE_J2: &str = "zz left out of J₂";
const MEAN: &str = "p for I₁";
const NO_APEX: &str = "no apex";
const VISCOUS: &str = "stress that depends on the rate";
const UNBOOKED: &str = "plastic work not booked";

type Values = Vec<(String, f64)>;

pub fn studies() -> Vec<Study> {
    let mut studies = of::<f64>(1e-12);
    studies.extend(of::<f32>(1e-5));
    studies.push(energy());
    studies
}

fn of<T: Real>(largest: f64) -> Vec<Study> {
    let study = |name: &str, claim: &str, run: fn(&Conditions) -> Values| {
        Study::new(format!("driver/{name}/{}", T::NAME), claim, move |conditions| {
            Measured::values(run(conditions))
        })
        .source(CLOSED)
        .expect(Expected::Bound { largest })
    };
    vec![
        study("triaxial", "triaxial slope, plateau and dilation are those of the cone", triaxial::<T>)
            .equations(&["23", "27", "29", "36"])
            .mutant(OTHER_CONE)
            .mutant(PLANE_J2)
            .mutant(MEAN),
        study("pyramid", "the plateaus of Mohr and Coulomb, in compression and extension", pyramid::<T>)
            .mutant(OTHER_CONE),
        study("plane strain", "a cone for plane strain fails where Mohr and Coulomb do", plane_strain::<T>)
            .equations(&["27", "29"])
            .mutant(OTHER_CONE),
        study("oedometer", "stress without lateral strain, yielding from the start", oedometer::<T>)
            .equations(&["27", "31", "32", "36"])
            .mutant(OTHER_CONE)
            .mutant(PLANE_J2)
            .mutant(MEAN),
        study("isochoric shear", "shear at constant volume raises the pressure", isochoric::<T>)
            .equations(&["31", "32", "36"])
            .mutant(OTHER_CONE)
            .mutant(MEAN),
        study("non-dilatant shear", "without dilatancy it does not", non_dilatant::<T>)
            .equations(&["27", "32"])
            .mutant(DENOMINATOR)
            .mutant(MEAN),
        study("apex", "soil pulled apart is left at the apex of its cone", apex::<T>).mutant(NO_APEX),
        study("scale back", "the paper's correction takes shear by r, and its energy", scale_back::<T>)
            .equations(&["27"])
            .mutant(PLANE_J2)
            .mutant(MEAN),
        study("admissible", "no update leaves a stress outside", admissible::<T>)
            .source("F ≤ 0 by definition; in units of the pressure")
            .mutant(DENOMINATOR)
            .mutant(PLANE_J2)
            .mutant(NO_APEX),
        study("rate", "a path gives the same stress however fast it is gone", rate::<T>)
            .source("the law is rate-independent")
            .mutant(VISCOUS),
    ]
}

/// E = 0.84 MPa, ν = 0.3: the sand column of the paper.
pub fn elasticity<T: Real>() -> Elasticity<T> {
    Elasticity::new(T::of(0.84e6), T::of(0.3)).expect("moduli")
}

pub fn cone<T: Real>(cone: Cone, friction: f64, dilatancy: f64) -> DruckerPrager<T> {
    DruckerPrager::new(cone, T::of(friction.to_radians()), T::of(dilatancy.to_radians())).expect("angles")
}

pub fn soil<T: Real, Y: YieldSurface<T>>(surface: Y) -> Soil<T, Y> {
    Soil::new(T::of(2650.0), elasticity(), surface).expect("a density")
}

/// A cone of the paper with what the conditions make wrong.
fn slipped<T: Real>(conditions: &Conditions, dilatancy: Option<f64>, friction: f64) -> Soil<T, Slipped<T>> {
    let slips = [
        (DENOMINATOR, Slip::AssociatedDenominator),
        (PLANE_J2, Slip::PlaneJ2),
        (MEAN, Slip::MeanForI1),
        (NO_APEX, Slip::NoApex),
    ];
    let slip = slips.iter().find(|(name, _)| conditions.is(name)).map_or(Slip::None, |slip| slip.1);
    let kind = match conditions.is(OTHER_CONE) {
        true => Cone::TriaxialExtension,
        false => Cone::PlaneStrainAssociated,
    };
    soil(Slipped { cone: cone(kind, friction, dilatancy.unwrap_or(friction)), slip })
}

fn run<T: Real, M: Material<T, Memory = SoilMemory<T>>>(
    law: M,
    start: SymTensor<T>,
    legs: &[Leg<T>],
    increments: usize,
) -> Vec<Row<T, SoilMemory<T>>> {
    let mut driver = Driver::new(law, SoilMemory::stressed(start));
    let mut rows = vec![driver.row()];
    for leg in legs {
        rows.extend(driver.follow(leg, increments).expect("a path the law can go"));
    }
    rows
}

fn isotropic<T: Real>(pressure: f64) -> SymTensor<T> {
    SymTensor::isotropic(T::of(-pressure))
}

fn relative(value: f64, exact: f64) -> f64 {
    value / exact - 1.0
}

/// α of (29).
fn printed(friction: f64) -> f64 {
    let tan = friction.to_radians().tan();
    tan / (9.0 + 12.0 * tan * tan).sqrt()
}

fn legs<T: Real>(kind: Kind, amount: f64) -> Vec<Leg<T>> {
    Path::new(kind, T::of(amount)).legs()
}

fn triaxial<T: Real>(conditions: &Conditions) -> Values {
    let mut values = Values::new();
    for friction in [19.8, 25.0, 30.0] {
        let a = 3.0_f64.sqrt() * printed(friction);
        // 1 kPa of lateral stress: it yields after less than 2 ‰.
        let rows = run::<T, _>(
            slipped(conditions, None, friction),
            isotropic(1e3),
            &legs(Kind::TriaxialCompression, 0.01),
            20,
        );
        let (first, last, before) = (&rows[1], &rows[20], &rows[10]);
        let axial = |row: &Row<T, _>| row.strain.0[2].as_f64();
        let slope = (first.stress.0[2].as_f64() + 1e3) / axial(first);
        let dilation =
            (last.strain.trace().as_f64() - before.strain.trace().as_f64()) / (axial(last) - axial(before));
        values.push((format!("slope at {friction}°"), relative(slope, 0.84e6)));
        let plateau = 3.0 * a / (1.0 - a) * 1e3;
        values.push((format!("plateau at {friction}°"), relative(last.shear_stress().as_f64(), plateau)));
        // A volume that grows as the axis shortens.
        values.push((format!("dilation at {friction}°"), relative(dilation, -3.0 * a / (1.0 - a))));
    }
    values
}

fn pyramid<T: Real>(conditions: &Conditions) -> Values {
    let mut values = Values::new();
    for (friction, dilatancy) in [(19.8_f64, 0.0_f64), (25.0, 10.0), (30.0, 30.0)] {
        let sin = friction.to_radians().sin();
        let angles = [friction, dilatancy].map(|angle| T::of(angle.to_radians()));
        let faces = MohrCoulomb::new(angles[0], angles[1]).expect("angles");
        let named = [
            (Kind::TriaxialCompression, Cone::TriaxialCompression, (1.0 + sin) / (1.0 - sin)),
            (Kind::TriaxialExtension, Cone::TriaxialExtension, (1.0 - sin) / (1.0 + sin)),
        ];
        for (kind, named, ratio) in named {
            let circular = if conditions.is(OTHER_CONE) { Cone::PlaneStrain } else { named };
            let path = legs(kind, 0.02);
            let plateau = |rows: &[Row<T, SoilMemory<T>>]| {
                let last = rows[rows.len() - 1].stress.0;
                relative(last[2].as_f64() / last[0].as_f64(), ratio)
            };
            let pyramid = run(soil(faces), isotropic(1e3), &path, 20);
            let cone = run(soil(cone::<T>(circular, friction, dilatancy)), isotropic(1e3), &path, 20);
            values.push((format!("{} at {friction}°, pyramid", kind.name()), plateau(&pyramid)));
            values.push((format!("{} at {friction}°, cone", kind.name()), plateau(&cone)));
        }
    }
    values
}

fn plane_strain<T: Real>(conditions: &Conditions) -> Values {
    let mut values = Values::new();
    let held = Control::Held;
    let none = Control::Strain(T::ZERO);
    // Shortened along z under constant σ_xx, no strain along y; far enough to forget the start.
    let leg = Leg::mixed([held, none, Control::Strain(T::of(-0.1)), none, none, none]);
    let cones = [
        (Cone::PlaneStrain, 25.0, 0.0),
        (Cone::PlaneStrain, 25.0, 12.0),
        (Cone::PlaneStrain, 25.0, 25.0),
        (Cone::PlaneStrainAssociated, 25.0, 25.0),
        (Cone::PlaneStrainNonDilatant, 25.0, 0.0),
    ];
    for (named, friction, dilatancy) in cones {
        let kind = if conditions.is(OTHER_CONE) { Cone::TriaxialCompression } else { named };
        let rows = run(soil(cone::<T>(kind, friction, dilatancy)), isotropic(1e3), &[leg], 400);
        let sin = friction.to_radians().sin();
        let last = rows[400].stress.0;
        let ratio = last[2].as_f64() / last[0].as_f64();
        let label = format!("{}, ψ = {dilatancy}°", named.name());
        values.push((label, relative(ratio, (1.0 + sin) / (1.0 - sin))));
    }
    values
}

fn oedometer<T: Real>(conditions: &Conditions) -> Values {
    let (k, g, a) = (0.84e6 / 1.2, 0.84e6 / 2.6, printed(19.8));
    let rate = (2.0 * g / 3.0_f64.sqrt() - 3.0 * a * k) / (g + 9.0 * a * a * k);
    let pressure = k + 3.0 * a * k * rate;
    let shear = 3.0 * a * pressure / 3.0_f64.sqrt();
    let rows =
        run::<T, _>(slipped(conditions, None, 19.8), SymTensor::zero(), &legs(Kind::Oedometer, 0.01), 10);
    let [xx, yy, zz, ..] = rows[10].stress.0.map(|x| x.as_f64() / 0.01);
    vec![
        ("zz".into(), relative(zz, -(pressure + 2.0 * shear))),
        ("xx".into(), relative(xx, -(pressure - shear))),
        ("yy".into(), relative(yy, -(pressure - shear))),
        ("zz by an independent prototype, ± 5e-8".into(), beyond(relative(zz, -1.081_578_5e6), 5e-8)),
        ("xx by an independent prototype, ± 2e-7".into(), beyond(relative(xx, -6.315_530e5), 2e-7)),
    ]
}

/// What of a deviation exceeds what is known.
fn beyond(deviation: f64, known: f64) -> f64 {
    (deviation.abs() - known).max(0.0)
}

fn isochoric<T: Real>(conditions: &Conditions) -> Values {
    let (k, g, a) = (0.84e6 / 1.2, 0.84e6 / 2.6, printed(19.8));
    let rows = run::<T, _>(slipped(conditions, None, 19.8), isotropic(1e3), &legs(Kind::PureShear, 0.01), 40);
    let yields = 3.0 * a * 1e3 / g;
    let pressure = 1e3 + 3.0 * a * k * g / (g + 9.0 * a * a * k) * (0.01 - yields);
    let last = &rows[40];
    vec![
        ("p".into(), relative(last.pressure().as_f64(), pressure)),
        ("√J₂".into(), relative(last.root_j2().as_f64(), 3.0 * a * pressure)),
        ("p by an independent prototype".into(), beyond(relative(pressure, 2684.315), 2e-7)),
    ]
}

fn non_dilatant<T: Real>(conditions: &Conditions) -> Values {
    let rows =
        run::<T, _>(slipped(conditions, Some(0.0), 19.8), isotropic(1e3), &legs(Kind::PureShear, 0.01), 40);
    let last = &rows[40];
    let (g, shear) = (0.84e6 / 2.6, 3.0 * printed(19.8) * 1e3);
    let plastic = 0.5 * (0.01 - shear / g);
    vec![
        ("p".into(), relative(last.pressure().as_f64(), 1e3)),
        ("√J₂".into(), relative(last.root_j2().as_f64(), shear)),
        ("plastic shear (79)".into(), relative(last.memory.plastic_strain.0[3].as_f64(), plastic)),
        (
            "equivalent plastic strain".into(),
            relative(last.memory.equivalent_plastic_strain.as_f64(), 2.0 * plastic / 3.0_f64.sqrt()),
        ),
    ]
}

fn apex<T: Real>(conditions: &Conditions) -> Values {
    let mut values = Values::new();
    for cohesion in [0.0, 500.0] {
        let base = cone::<T>(Cone::PlaneStrainAssociated, 25.0, 25.0);
        let cone =
            DruckerPrager::from_constants(base.friction(), base.dilatancy(), T::of(cohesion)).expect("k_c");
        let slip = if conditions.is(NO_APEX) { Slip::NoApex } else { Slip::None };
        let pull = T::of(0.02);
        let strain = SymTensor([pull, pull, pull * T::of(1.5), pull * T::of(0.2), T::ZERO, T::ZERO]);
        let rows = run(soil(Slipped { cone, slip }), isotropic(1e3), &[Leg::strain(strain)], 10);
        let exact = SymTensor::<T>::isotropic(T::of(cohesion / (3.0 * printed(25.0))));
        for (k, (value, exact)) in rows[10].stress.0.iter().zip(exact.0).enumerate() {
            values.push((format!("component {k}, k_c = {cohesion}"), (*value - exact).as_f64() / 1e3));
        }
    }
    values
}

fn scale_back<T: Real>(conditions: &Conditions) -> Values {
    let law = slipped::<T>(conditions, None, 25.0).with_plasticity(Plasticity::Rate);
    // √J₂ is well above what 1 kPa bears.
    let stress = SymTensor([-1700.0, -400.0, -900.0, 350.0, -120.0, 210.0].map(T::of));
    let tau = stress.deviator();
    let second = 0.5 * tau.double_dot(&tau).as_f64();
    let r = -printed(25.0) * stress.trace().as_f64() / second.sqrt();
    let (memory, loss) = law.admit(SoilMemory::stressed(stress));
    let lost = (1.0 - r * r) * 2.0 * second / (4.0 * 0.84e6 / 2.6);
    let mut values = vec![("energy".into(), relative(loss.scale_back.as_f64(), lost))];
    for k in 0..6 {
        let exact = tau.0[k].as_f64() * r + if k < 3 { stress.trace().as_f64() / 3.0 } else { 0.0 };
        values.push((format!("component {k}"), (memory.stress.0[k].as_f64() - exact) / 1e3));
    }
    values
}

/// Random stresses, most of them beyond the surface and some of them huge, brought back to it.
fn admissible<T: Real>(conditions: &Conditions) -> Values {
    let mut values = Values::new();
    let mut random = Random::new(11);
    for dilatancy in [0.0, 10.0, 25.0] {
        let law = slipped::<T>(conditions, Some(dilatancy), 25.0);
        let mut worst = 0.0_f64;
        for _ in 0..2000 {
            let size = 10_f64.powf(random.between(1.0, 6.0));
            let trial = SymTensor(core::array::from_fn(|_| T::of(size * random.between(-1.0, 1.0))));
            let (memory, _) = law.admit(SoilMemory::stressed(trial));
            let excess = law.surface().excess(&memory.stress).as_f64();
            // At the apex, where p = 0, the trial's own rounding is the measure.
            let pressure = memory.pressure().as_f64().abs().max(1e-6 * size);
            worst = worst.max(excess / pressure);
        }
        values.push((format!("ψ = {dilatancy}°"), worst));
    }
    values
}

/// A path of plastic loading, unloading and turning.
fn wandering<T: Real>() -> Vec<Leg<T>> {
    let leg =
        |strain: [f64; 6], turn: [f64; 3]| Leg::strain(SymTensor(strain.map(T::of))).turning(turn.map(T::of));
    vec![
        leg([0.0, -0.001, -0.004, 0.001, 0.0, 0.002], [0.1, 0.0, 0.05]),
        leg([0.001, 0.001, 0.002, -0.003, 0.001, 0.0], [0.0, 0.2, 0.0]),
        leg([-0.002, 0.0, -0.001, 0.0, 0.003, -0.001], [0.1, -0.1, 0.0]),
    ]
}

fn rate<T: Real>(conditions: &Conditions) -> Values {
    let mistake = if conditions.is(VISCOUS) { Mistake::Viscous } else { Mistake::None };
    let law = Mistaken { soil: soil(cone::<T>(Cone::PlaneStrain, 25.0, 5.0)), mistake };
    let at = |duration: f64| {
        let legs = wandering::<T>().into_iter().map(|leg| leg.lasting(T::of(duration)).expect("a time"));
        let legs: Vec<_> = legs.collect();
        run(law.clone(), isotropic(1e3), &legs, 10)[30].stress
    };
    let slow = at(1e3);
    let apart = |other: SymTensor<T>| {
        let squared = (other - slow).double_dot(&(other - slow)) / slow.double_dot(&slow);
        squared.as_f64().sqrt()
    };
    vec![("in 1 s".into(), apart(at(1.0))), ("in 1 µs".into(), apart(at(1e-6)))]
}

/// What is booked is the work of the stress on the surface: of the first order in the increment.
fn energy() -> Study {
    Study::new(
        "driver/energy/f64",
        "what work is neither stored nor booked as lost falls with the increment (values: its part of the work)",
        |conditions| {
            Measured::errors([50, 100, 200, 400].map(|increments| {
                (1.0 / increments as f64, unbooked(increments, conditions))
            }))
        },
    )
    .source("first law; stored energy is p²/2K + τ:τ/4G; the return is that of an implicit Euler step")
    .expect(Expected::Order { at_least: 0.9, at_most: 2.2 })
    .mutant(UNBOOKED)
}

/// Over three dilatancies, the largest part of the work no one explains.
fn unbooked(increments: usize, conditions: &Conditions) -> f64 {
    let mistake = if conditions.is(UNBOOKED) { Mistake::Unbooked } else { Mistake::None };
    let start = isotropic::<f64>(1e3);
    let open = |dilatancy: f64| {
        let law = Mistaken { soil: soil(cone::<f64>(Cone::PlaneStrain, 25.0, dilatancy)), mistake };
        let rows = run(law, start, &wandering(), increments);
        let last = &rows[3 * increments];
        let stored = elasticity::<f64>().energy(&last.stress) - elasticity::<f64>().energy(&start);
        (last.work - stored - last.lost.total()).abs() / last.work.abs().max(stored.abs())
    };
    [0.0, 10.0, 25.0].map(open).into_iter().fold(0.0, f64::max)
}
