//! Particles as VTK XML PolyData: binary, appended, readable by ParaView and every VTK reader.

use super::pvd::escaped;
use super::write_whole;
use crate::real::Real;
use crate::space::{SymTensor, Vector};
use core::fmt;
use std::io::{self, Write};
use std::path::Path;

/// A number as it is stored: `f32`, `f64`, `u8`, `u32` or `i64`, little-endian. Sealed.
pub trait Component: Copy + sealed::Sealed {
    /// The type's name in the file.
    const TYPE: &'static str;
    /// Appends the bytes.
    fn put(self, bytes: &mut Vec<u8>);
}

mod sealed {
    /// Closes [`super::Component`].
    pub trait Sealed {}
}

macro_rules! component {
    ($($t:ty: $name:literal),*) => { $(
        impl sealed::Sealed for $t {}
        impl Component for $t {
            const TYPE: &'static str = $name;
            fn put(self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_le_bytes());
            }
        }
    )* };
}
component!(f32: "Float32", f64: "Float64", u8: "UInt8", u32: "UInt32", i64: "Int64");

/// An array of another length than the positions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LengthError {
    /// The array's name.
    pub name: String,
    /// Its length.
    pub length: usize,
    /// The number of particles.
    pub particles: usize,
}

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "array `{}` has {} values for {} particles", self.name, self.length, self.particles)
    }
}

impl core::error::Error for LengthError {}

#[derive(Clone, Debug)]
struct Block {
    name: String,
    kind: &'static str,
    components: usize,
    bytes: Vec<u8>,
}

/// Particles at one instant, ready to be written as a `.vtp` file.
///
/// Positions and vectors are padded to three dimensions, a vertex is written for each particle (else
/// ParaView shows nothing), and stress is in ParaView's order XX YY ZZ XY YZ XZ.
///
/// ```
/// use alluvium::{Vector, output::Vtp};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let positions = [Vector([0.0_f64, 0.0]), Vector([0.1, 0.0])];
/// let file = Vtp::new(0.5, &positions)
///     .scalar("pressure", [981.0_f64, 981.0])?
///     .vector("velocity", [Vector([0.0_f64, 1.0]), Vector([0.0, 1.0])])?
///     .scalar("id", [0_u32, 1])?;
/// let mut bytes = Vec::new();
/// file.write_to(&mut bytes)?;
/// # assert!(bytes.starts_with(b"<?xml"));
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Vtp {
    time: f64,
    particles: usize,
    points: Block,
    arrays: Vec<Block>,
}

impl Vtp {
    /// Particles at `positions` \[m\] and `time` \[s\], with no arrays yet.
    pub fn new<T: Real + Component, const D: usize>(time: f64, positions: &[Vector<T, D>]) -> Self {
        let points = block("position", 3, positions.iter().flat_map(|x| padded(*x)));
        Self { time, particles: positions.len(), points, arrays: Vec::new() }
    }

    /// How many particles there are.
    pub fn particles(&self) -> usize {
        self.particles
    }

    /// Adds one number per particle.
    ///
    /// # Errors
    /// If there are more or fewer values than particles.
    pub fn scalar<C: Component>(
        self,
        name: &str,
        values: impl IntoIterator<Item = C>,
    ) -> Result<Self, LengthError> {
        self.with(block(name, 1, values))
    }

    /// Adds one vector per particle, padded to three dimensions.
    ///
    /// # Errors
    /// If there are more or fewer values than particles.
    pub fn vector<T: Real + Component, const D: usize>(
        self,
        name: &str,
        values: impl IntoIterator<Item = Vector<T, D>>,
    ) -> Result<Self, LengthError> {
        self.with(block(name, 3, values.into_iter().flat_map(padded)))
    }

    /// Adds one symmetric tensor per particle, in the order XX YY ZZ XY YZ XZ.
    ///
    /// # Errors
    /// If there are more or fewer values than particles.
    pub fn tensor<T: Real + Component>(
        self,
        name: &str,
        values: impl IntoIterator<Item = SymTensor<T>>,
    ) -> Result<Self, LengthError> {
        self.with(block(name, 6, values.into_iter().flat_map(|t| t.0)))
    }

    fn with(mut self, block: Block) -> Result<Self, LengthError> {
        let width = match block.kind {
            "UInt8" => 1,
            "UInt32" | "Float32" => 4,
            _ => 8,
        };
        let length = block.bytes.len() / (width * block.components);
        if length != self.particles {
            return Err(LengthError { name: block.name, length, particles: self.particles });
        }
        self.arrays.push(block);
        Ok(self)
    }

    /// Writes the file, whole or not at all.
    ///
    /// # Errors
    /// The file system's.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        write_whole(path, |out| self.write_to(out))
    }

    /// Writes the file's bytes.
    ///
    /// # Errors
    /// The sink's.
    pub fn write_to(&self, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        let connectivity = block("connectivity", 1, 0..self.particles as i64);
        let offsets = block("offsets", 1, 1..=self.particles as i64);
        let blocks: Vec<&Block> = self.arrays.iter().chain([&self.points, &connectivity, &offsets]).collect();
        self.header(out, &blocks)?;
        out.write_all(b"_")?;
        for block in blocks {
            out.write_all(&(block.bytes.len() as u64).to_le_bytes())?;
            out.write_all(&block.bytes)?;
        }
        out.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
    }

    fn header(&self, out: &mut (impl Write + ?Sized), blocks: &[&Block]) -> io::Result<()> {
        let n = self.particles;
        let (arrays, rest) = blocks.split_at(self.arrays.len());
        let mut offset = 0;
        writeln!(out, r#"<?xml version="1.0"?>"#)?;
        writeln!(
            out,
            r#"<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
        )?;
        writeln!(out, "  <PolyData>\n    <FieldData>")?;
        writeln!(
            out,
            r#"      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{:?}</DataArray>"#,
            self.time
        )?;
        writeln!(out, "    </FieldData>")?;
        writeln!(
            out,
            r#"    <Piece NumberOfPoints="{n}" NumberOfVerts="{n}" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">"#
        )?;
        section(out, "PointData", arrays, &mut offset)?;
        section(out, "Points", &rest[..1], &mut offset)?;
        section(out, "Verts", &rest[1..], &mut offset)?;
        write!(out, "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   ")
    }
}

fn section(
    out: &mut (impl Write + ?Sized),
    name: &str,
    blocks: &[&Block],
    offset: &mut usize,
) -> io::Result<()> {
    writeln!(out, "      <{name}>")?;
    for block in blocks {
        writeln!(
            out,
            r#"        <DataArray type="{}" Name="{}" NumberOfComponents="{}"{} format="appended" offset="{offset}"/>"#,
            block.kind,
            escaped(&block.name),
            block.components,
            component_names(block.components),
        )?;
        *offset += 8 + block.bytes.len();
    }
    writeln!(out, "      </{name}>")
}

fn component_names(components: usize) -> String {
    let names: &[&str] = match components {
        3 => &["X", "Y", "Z"],
        6 => &["XX", "YY", "ZZ", "XY", "YZ", "XZ"],
        _ => &[],
    };
    names.iter().enumerate().map(|(k, name)| format!(r#" ComponentName{k}="{name}""#)).collect()
}

fn block<C: Component>(name: &str, components: usize, values: impl IntoIterator<Item = C>) -> Block {
    let mut bytes = Vec::new();
    for value in values {
        value.put(&mut bytes);
    }
    Block { name: name.to_owned(), kind: C::TYPE, components, bytes }
}

fn padded<T: Real, const D: usize>(v: Vector<T, D>) -> [T; 3] {
    core::array::from_fn(|k| if k < D { v.0[k] } else { T::ZERO })
}
