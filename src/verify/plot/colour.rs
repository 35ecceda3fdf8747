//! Colours that keep their order for every eye and in print.

/// Colours of series, in order of use: those of Okabe and Ito, then some for stacks of many parts.
pub const SERIES: [&str; 14] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#555555", "#f0e442", "#7b3294",
    "#8c510a", "#01665e", "#bdbdbd", "#9e0142", "#b8e186",
];

/// Anchors of the map viridis, evenly spaced.
const VIRIDIS: [u32; 16] = [
    0x44_01_54, 0x48_1a_6c, 0x47_2f_7d, 0x41_44_87, 0x39_56_8c, 0x31_68_8e, 0x2a_78_8e, 0x23_88_8e,
    0x1f_98_8b, 0x22_a8_84, 0x35_b7_79, 0x54_c5_68, 0x7a_d1_51, 0xa5_db_36, 0xd2_e2_1b, 0xfd_e7_25,
];

/// The map's colour at `x` from 0 to 1; beyond, its ends.
pub fn viridis(x: f64) -> String {
    let last = VIRIDIS.len() - 1;
    let x = if x.is_finite() { x.clamp(0.0, 1.0) * last as f64 } else { 0.0 };
    let k = (x as usize).min(last - 1);
    let part = |anchor: u32, shift: u32| f64::from(anchor >> shift & 0xff);
    let mix = |shift| {
        let (a, b) = (part(VIRIDIS[k], shift), part(VIRIDIS[k + 1], shift));
        (a + (b - a) * (x - k as f64)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(16), mix(8), mix(0))
}
