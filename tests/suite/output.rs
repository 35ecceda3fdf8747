//! The files of a run, read back.

use alluvium::Vector;
use alluvium::output::{Cell, Table, TableError, TableWriter, Vtp};
use alluvium::space::SymTensor;
use std::path::PathBuf;

/// A folder of its own for each test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("alluvium-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// One array of a `.vtp` file: type, components, bytes.
pub fn array(file: &[u8], name: &str) -> (String, usize, Vec<u8>) {
    let start = file.windows(22).position(|w| w == b"AppendedData encoding=").unwrap();
    let mark = start + file[start..].iter().position(|&b| b == b'_').unwrap() + 1;
    let header = std::str::from_utf8(&file[..start]).unwrap();
    let tag = header.lines().find(|line| line.contains(&format!("Name=\"{name}\""))).unwrap();
    let attribute = |key: &str| tag.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap();
    let at = mark + attribute("offset").parse::<usize>().unwrap();
    let size = u64::from_le_bytes(file[at..at + 8].try_into().unwrap()) as usize;
    let components = attribute("NumberOfComponents").parse().unwrap();
    (attribute(" type").to_owned(), components, file[at + 8..at + 8 + size].to_vec())
}

pub fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
}

fn longs(bytes: &[u8]) -> Vec<i64> {
    bytes.chunks_exact(8).map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
}

#[test]
fn particles_come_back_as_written() {
    let folder = folder("vtp");
    let path = folder.join("water_0000.vtp");
    let positions = [Vector([0.25_f64, -1.5]), Vector([3.0, 4.0]), Vector([1e-9, 0.0])];
    Vtp::new(0.125, &positions)
        .scalar("pressure", [1.0_f64, f64::MIN_POSITIVE, -3.5])
        .and_then(|f| f.vector("velocity", [[1.0_f32, 2.0], [3.0, 4.0], [5.0, 6.0]].map(Vector)))
        .and_then(|f| f.tensor("stress", [SymTensor([1.0_f64, 2.0, 3.0, 4.0, 5.0, 6.0]); 3]))
        .and_then(|f| f.scalar("id", [7_u32, 8, 9]))
        .and_then(|f| f.scalar("kind", [0_u8, 1, 0]))
        .unwrap()
        .write(&path)
        .unwrap();
    let file = std::fs::read(&path).unwrap();
    let (kind, components, bytes) = array(&file, "position");
    assert_eq!((kind.as_str(), components), ("Float64", 3));
    assert_eq!(doubles(&bytes), [0.25, -1.5, 0.0, 3.0, 4.0, 0.0, 1e-9, 0.0, 0.0]);
    assert_eq!(doubles(&array(&file, "pressure").2), [1.0, f64::MIN_POSITIVE, -3.5]);
    let (kind, components, bytes) = array(&file, "velocity");
    assert_eq!((kind.as_str(), components, bytes.len()), ("Float32", 3, 36));
    assert_eq!(bytes[12..16], 3.0_f32.to_le_bytes());
    assert_eq!(doubles(&array(&file, "stress").2)[6..12], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(array(&file, "id"), ("UInt32".into(), 1, vec![7, 0, 0, 0, 8, 0, 0, 0, 9, 0, 0, 0]));
    assert_eq!(array(&file, "kind"), ("UInt8".into(), 1, vec![0, 1, 0]));
    assert_eq!(longs(&array(&file, "connectivity").2), [0, 1, 2]);
    assert_eq!(longs(&array(&file, "offsets").2), [1, 2, 3]);
    let text = String::from_utf8_lossy(&file);
    for part in ["NumberOfPoints=\"3\" NumberOfVerts=\"3\"", "header_type=\"UInt64\"", ">0.125</DataArray>"] {
        assert!(text.contains(part), "{part}");
    }
    assert!(text.ends_with("</VTKFile>\n"));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1, "no temporary file is left");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn an_array_of_another_length_is_refused() {
    let error = Vtp::new(0.0, &[Vector([0.0_f32; 3])]).scalar("mass", [1.0_f32, 2.0]).unwrap_err();
    assert_eq!(error.to_string(), "array `mass` has 2 values for 1 particles");
}

#[test]
fn no_particles_are_a_valid_file_too() {
    let mut bytes = Vec::new();
    Vtp::new::<f64, 2>(0.0, &[]).write_to(&mut bytes).unwrap();
    assert_eq!(array(&bytes, "position").2.len(), 0);
}

#[test]
fn a_history_is_readable_while_it_grows() {
    let folder = folder("table");
    let path = folder.join("history.csv");
    let mut table = TableWriter::create(&path, &["time [s]", "front [m]", "limit"]).unwrap();
    for n in 1..=3_u64 {
        let time = 0.1 * n as f64;
        table.row(&[time.into(), (0.1 + time).into(), "acoustic".into()]).unwrap();
        let read = Table::parse(&std::fs::read_to_string(&path).unwrap()).unwrap();
        assert_eq!(read.rows() as u64, n);
        assert_eq!(read.column("time [s]").unwrap().last(), Some(&time), "exactly the same number");
        assert_eq!(read.text("limit").unwrap().last(), Some(&"acoustic"));
    }
    assert!(table.row(&[Cell::Count(1)]).is_err());
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_bad_table_says_where() {
    let error = Table::parse("T,Z\n0,1\n1,2,3\n").unwrap_err();
    assert_eq!(error, TableError::Width { line: 3, entries: 3, columns: 2 });
    let table = Table::parse("# source\nT,Z\n0,x\n").unwrap();
    assert_eq!(table.column("Z").unwrap_err().to_string(), "line 3, column `Z`: `x` is not a number");
    assert_eq!(table.column("X").unwrap_err().to_string(), "no column `X`; there are T, Z");
    assert_eq!(Table::parse("# nothing\n").unwrap_err(), TableError::NoHeader);
}
