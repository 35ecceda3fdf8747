//! A study in both dimensions and both precisions.

/// `study::<T, D>("name/2d/f64", …, bar)` and its three siblings, with one bar for doubles and one for singles.
macro_rules! every_rung {
    ($study:ident, $name:expr $(, $more:expr)*; $double:expr, $single:expr) => {
        [
            $study::<f64, 2>(&format!("{}/2d/f64", $name) $(, $more)*, $double),
            $study::<f64, 3>(&format!("{}/3d/f64", $name) $(, $more)*, $double),
            $study::<f32, 2>(&format!("{}/2d/f32", $name) $(, $more)*, $single),
            $study::<f32, 3>(&format!("{}/3d/f32", $name) $(, $more)*, $single),
        ]
    };
}
pub(crate) use every_rung;
