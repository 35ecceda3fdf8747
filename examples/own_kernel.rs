//! A kernel of one's own, Lucy's of 1977, against the library's: how well do they sum on a lattice?

use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::neighbours::CellList;
use alluvium::summation::{Cloud, Form, Neighbourhood};
use alluvium::{Num, Real, setup};

/// `W = α (1 + 3s)(1 − s)³`, `s = r/2h`, in 2D.
#[derive(Clone, Copy, Debug)]
struct Lucy<T> {
    h: T,
}

impl<T: Real> Lucy<T> {
    fn height(&self) -> T {
        T::of(5.0 / (4.0 * core::f64::consts::PI)) / (self.h * self.h)
    }
}

impl<T: Real> Kernel<T, 2> for Lucy<T> {
    fn smoothing_length(&self) -> T {
        self.h
    }
    fn support(&self) -> T {
        self.h + self.h
    }
    #[inline(always)]
    fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
        let s = r2.sqrt() / N::splat(self.support());
        let t = (N::lit(1.0) - s).max(N::lit(0.0));
        N::splat(self.height()) * (N::lit(1.0) + N::lit(3.0) * s) * (t * t * t)
    }
    #[inline(always)]
    fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
        let support = N::splat(self.support());
        let t = (N::lit(1.0) - r2.sqrt() / support).max(N::lit(0.0));
        N::lit(-12.0) * N::splat(self.height()) / (support * support) * (t * t)
    }
}

/// Sum of one and slope of x in the middle of a lattice: both should be one.
fn quality(kernel: &impl Kernel<f64, 2>) -> Result<(f64, f64), Box<dyn std::error::Error>> {
    let x = setup::fill([0.0; 2], [21.0; 2], 1.0);
    let mut near = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), kernel.support());
    near.rebuild(&x, 0);
    let (ones, height) = (vec![1.0; x.len()], x.iter().map(|x| x[0]).collect::<Vec<_>>());
    let cloud = Cloud::new(&near, kernel, &x, &ones, &ones)?;
    Ok((cloud.shepard()[220], cloud.gradient(Form::Difference, &height)[220][0]))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for h in [1.0, 1.2, 1.3, 1.5, 2.0] {
        let (lucy, wendland) = (quality(&Lucy { h })?, quality(&WendlandC2::new(h)?)?);
        println!(
            "h = {h} Δx: Lucy {:.4} {:.4}, Wendland C2 {:.4} {:.4}",
            lucy.0, lucy.1, wendland.0, wendland.1
        );
    }
    Ok(())
}
