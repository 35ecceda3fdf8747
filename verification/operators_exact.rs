//! What operators must give to the last digits: linear fields, conservation, duality, and the
//! errors on a lattice an independent program found.

use crate::bench::Bench;
use crate::operators::{Operator, error};
use alluvium::kernel::WendlandC2;
use alluvium::summation::Form;
use alluvium::verify::{Arrangement, Conditions, Expected, Measured, Random, Study, l_infinity};
use alluvium::{Real, Vector};

/// Jitter, h/Δx, particles along an edge, and relative L2 errors of (50), (51), (46), Bonet & Lok,
/// ΣVW − 1, (44) over the variation of f, Morris's Laplacian.
const TABLE: &str = include_str!("data/operator_errors_lattice_2d.csv");
const SWAPPED: &str = "swapped index in the correction matrix";
const TRANSPOSED: &str = "transposed gradient";
const WEIGHT: &str = "weight m_j/ρ_j for m_j/ρ_i";
const SIGN: &str = "own value with the other sign";
const RATIO: &str = "h/Δx larger by 0.1 %";

pub fn studies() -> Vec<Study> {
    let mut studies = linear();
    studies.extend([
        Study::new(
            "operators/table",
            "on a lattice the errors of the operators are those of an independent program, relative deviation",
            table,
        )
        .equations(&["44", "46", "50", "51"])
        .source("operator_errors_lattice_2d.csv, printed with five digits")
        .expect(Expected::Bound { largest: 1e-4 })
        .mutant(RATIO),
        Study::new("operators/conservation/2d", "Σ V ⟨∇f⟩ of (51) vanishes, relative to Σ V |⟨∇f⟩|", conserved::<f64, 2>)
            .equations(&["51"])
            .source("antisymmetry of each pair")
            .expect(Expected::Bound { largest: 1e-13 })
            .mutant(SIGN),
        Study::new("operators/conservation/3d", "the same in 3D", conserved::<f64, 3>)
            .equations(&["51"])
            .expect(Expected::Bound { largest: 1e-13 })
            .mutant(SIGN),
        Study::new("operators/conservation/2d/f32", "the same in single precision", conserved::<f32, 2>)
            .equations(&["51"])
            .expect(Expected::Bound { largest: 1e-5 })
            .mutant(SIGN),
        Study::new("operators/conservation/3d/f32", "the same in single precision, 3D", conserved::<f32, 3>)
            .equations(&["51"])
            .expect(Expected::Bound { largest: 1e-5 })
            .mutant(SIGN),
        Study::new(
            "operators/duality/2d",
            "the gradient (51) is minus the adjoint of the divergence (50), for any densities",
            dual::<f64, 2>,
        )
        .equations(&["50", "51"])
        .source("exchange of i and j; the weights of (65) as printed break it")
        .expect(Expected::Bound { largest: 1e-13 })
        .mutant(WEIGHT),
        Study::new("operators/duality/3d", "the same in 3D", dual::<f64, 3>)
            .equations(&["50", "51"])
            .expect(Expected::Bound { largest: 1e-13 })
            .mutant(WEIGHT),
        Study::new("operators/duality/2d/f32", "the same in single precision", dual::<f32, 2>)
            .equations(&["50", "51"])
            .expect(Expected::Bound { largest: 1e-5 })
            .mutant(WEIGHT),
        Study::new("operators/duality/3d/f32", "the same in single precision, 3D", dual::<f32, 3>)
            .equations(&["50", "51"])
            .expect(Expected::Bound { largest: 1e-5 })
            .mutant(WEIGHT),
    ]);
    studies
}

fn linear() -> Vec<Study> {
    let claim = "corrected gradients of linear fields are exact at any disorder and at surfaces";
    let study = |name: &str, run: fn(&Conditions) -> Measured, largest| {
        Study::new(name, claim, run)
            .source("construction of the correction (Bonet & Lok 1999)")
            .expect(Expected::Bound { largest })
            .mutant(SWAPPED)
            .mutant(TRANSPOSED)
    };
    vec![
        study("operators/linear/2d", linear_error::<f64, 2>, 1e-12),
        study("operators/linear/3d", linear_error::<f64, 3>, 1e-12),
        study("operators/linear/2d/f32", linear_error::<f32, 2>, 1e-4),
        study("operators/linear/3d/f32", linear_error::<f32, 3>, 1e-4),
    ]
}

fn kernel<T: Real, const D: usize>(ratio: f64, arrangement: &Arrangement<D>) -> WendlandC2<T, D> {
    WendlandC2::new(T::of(ratio * arrangement.spacing)).expect("a length")
}

/// Largest error of the gradients of a linear scalar and a linear vector field.
fn linear_error<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let side = if D == 2 { 20 } else { 9 };
    let slope = |a: usize, b: usize| 0.3 + a as f64 - 0.7 * (b * b) as f64;
    let error = |jitter: f64| {
        let arrangement = Arrangement::<D>::jittered(side, jitter, 7);
        let bench = Bench::new(&arrangement, kernel(1.5, &arrangement), false);
        let cloud = bench.cloud();
        let mut corrections = cloud.corrections();
        assert_eq!(corrections.uncorrected, 0);
        if conditions.is(SWAPPED) {
            corrections.matrices.iter_mut().for_each(|matrix| matrix.swap(0, 1));
        }
        let component = |a: usize| move |x: [f64; D]| 1.0 + (0..D).map(|b| slope(a, b) * x[b]).sum::<f64>();
        let scalar = cloud.corrected_gradient(&corrections, &bench.field(component(0)));
        let fields: [Vec<T>; D] = core::array::from_fn(|a| bench.field(component(a)));
        let vectors: Vec<_> =
            (0..cloud.len()).map(|i| Vector(core::array::from_fn(|a| fields[a][i]))).collect();
        let tensor = cloud.corrected_vector_gradient(&corrections, &vectors);
        let (mut measured, mut exact) = (Vec::new(), Vec::new());
        for (vector, tensor) in scalar.iter().zip(&tensor) {
            for a in 0..D {
                measured.push(vector[a].as_f64());
                exact.push(slope(0, a));
                for b in 0..D {
                    let (a, b) = if conditions.is(TRANSPOSED) { (b, a) } else { (a, b) };
                    measured.push(tensor[a][b].as_f64());
                }
                exact.extend((0..D).map(|b| slope(a, b)));
            }
        }
        (format!("jitter {jitter}"), l_infinity(&measured, &exact))
    };
    Measured::values([0.0, 0.1, 0.3].map(error))
}

/// A disordered cloud with densities that vary by a tenth, and random values from -1 to 1.
fn random_cloud<T: Real, const D: usize>() -> (Bench<T, WendlandC2<T, D>, D>, Random) {
    let side = if D == 2 { 24 } else { 8 };
    let arrangement = Arrangement::<D>::jittered(side, 0.2, 3);
    let mut bench = Bench::new(&arrangement, kernel(1.3, &arrangement), true);
    let mut random = Random::new(11);
    for density in &mut bench.densities {
        *density = T::of(random.between(0.9, 1.1));
    }
    (bench, random)
}

fn conserved<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let (bench, mut random) = random_cloud::<T, D>();
    let cloud = bench.cloud();
    let values: Vec<T> = bench.x.iter().map(|_| T::of(random.between(-1.0, 1.0))).collect();
    let form = if conditions.is(SIGN) { Form::Difference } else { Form::Symmetric };
    let gradients = cloud.gradient(form, &values);
    let (mut sum, mut scale) = ([0.0; D], 0.0);
    for (i, gradient) in gradients.iter().enumerate() {
        let volume = cloud.volume(i).as_f64();
        for k in 0..D {
            sum[k] += volume * gradient[k].as_f64();
        }
        scale += volume * gradient.norm().as_f64();
    }
    Measured::values(sum.into_iter().enumerate().map(|(k, sum)| (format!("axis {k}"), sum / scale)))
}

/// Σ V_i (v_i·⟨∇p⟩_i + p_i ⟨∇·v⟩_i) over the sum of magnitudes.
fn dual<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let (bench, mut random) = random_cloud::<T, D>();
    let cloud = bench.cloud();
    let pressures: Vec<T> = bench.x.iter().map(|_| T::of(random.between(-1.0, 1.0))).collect();
    let velocities: Vec<Vector<T, D>> =
        bench.x.iter().map(|_| Vector(core::array::from_fn(|_| T::of(random.between(-1.0, 1.0))))).collect();
    let form = if conditions.is(WEIGHT) { Form::VolumeDifference } else { Form::Difference };
    let gradients = cloud.gradient(Form::Symmetric, &pressures);
    let divergences = cloud.divergence(form, &velocities);
    let (mut sum, mut scale) = (0.0, 0.0);
    for i in 0..cloud.len() {
        let volume = cloud.volume(i).as_f64();
        let power = volume * velocities[i].dot(gradients[i]).as_f64();
        let work = volume * (pressures[i] * divergences[i]).as_f64();
        sum += power + work;
        scale += power.abs() + work.abs();
    }
    Measured::value(sum / scale)
}

/// Measured error over tabulated error, less one.
fn table(conditions: &Conditions) -> Measured {
    let mut values = Vec::new();
    for line in TABLE.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
        let (ratio, side) = (row[1] * if conditions.is(RATIO) { 1.001 } else { 1.0 }, row[2] as usize);
        if side > 100 {
            continue;
        }
        let arrangement = Arrangement::<2>::lattice(side);
        let operators = [
            ("(50)", Operator::Gradient(Form::Difference), 3),
            ("(51)", Operator::Gradient(Form::Symmetric), 4),
            ("(46)", Operator::Gradient(Form::Plain), 5),
            ("corrected", Operator::Corrected, 6),
            ("Laplacian", Operator::Laplacian, 9),
        ];
        for (name, operator, column) in operators {
            let measured = error::<f64, 2>(operator, &arrangement, ratio, &Conditions::default());
            values.push((format!("{name}, h/Δx = {}, n = {side}", row[1]), measured / row[column] - 1.0));
        }
    }
    Measured::values(values)
}
