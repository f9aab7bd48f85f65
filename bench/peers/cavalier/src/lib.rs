//! Functions of both programs: contours from binary files, measures of results, the time and the memory of the process.

use cavalier_contours::polyline::{PlineCreation, PlineSource, PlineSourceMut, Polyline};
use std::fs::{self, File};
use std::io::{self, BufReader, ErrorKind, Read};

/// One little-endian number of eight bytes, or nothing at the end of the file.
pub fn number(from: &mut impl Read) -> io::Result<Option<[u8; 8]>> {
    let mut bytes = [0; 8];
    match from.read_exact(&mut bytes) {
        Ok(()) => Ok(Some(bytes)),
        Err(e) if e.kind() == ErrorKind::UnexpectedEof => Ok(None),
        Err(e) => Err(e),
    }
}

/// A closed polyline of the given number of vertices, each with x, y and bulge.
pub fn vertices(from: &mut impl Read, count: usize) -> io::Result<Polyline<f64>> {
    let mut polyline = Polyline::with_capacity(count, true);
    for _ in 0..count {
        let mut vertex = [0.0; 3];
        for part in &mut vertex {
            *part = f64::from_le_bytes(number(from)?.ok_or(ErrorKind::UnexpectedEof)?);
        }
        polyline.add(vertex[0], vertex[1], vertex[2]);
    }
    Ok(polyline)
}

/// The contour of a file that contains nothing else.
pub fn contour(path: &str) -> io::Result<Polyline<f64>> {
    let file = File::open(path)?;
    let count = file.metadata()?.len() as usize / 24;
    vertices(&mut BufReader::new(file), count)
}

/// Area (positive counter-clockwise) and length, by the formulas that all programs of the benchmark use.
pub fn measures(polyline: &Polyline<f64>) -> (f64, f64) {
    let count = polyline.vertex_count();
    if count == 0 {
        return (0.0, 0.0);
    }
    let origin = polyline.at(0);
    let (mut area, mut length) = (0.0, 0.0);
    let segments = if polyline.is_closed() { count } else { count - 1 };
    for i in 0..segments {
        let (a, b) = (polyline.at(i), polyline.at((i + 1) % count));
        let (ax, ay) = (a.x - origin.x, a.y - origin.y);
        let square = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
        area += 0.5 * (ax * (b.y - origin.y) - (b.x - origin.x) * ay);
        let g = a.bulge;
        if g.abs() < 1e-3 {
            area += square * g / 3.0 * (1.0 + g * g / 5.0);
            length += square.sqrt() * (1.0 + 2.0 / 3.0 * g * g);
        } else {
            let sweep = 4.0 * g.atan();
            let half = (sweep / 2.0).sin();
            area += square * (sweep - sweep.sin()) / (8.0 * half * half);
            length += square.sqrt() * sweep / (2.0 * half);
        }
    }
    (area, length)
}

/// Nanoseconds of processor time that the process has used.
pub fn processor() -> u64 {
    #[repr(C)]
    struct Time {
        seconds: i64,
        nanoseconds: i64,
    }
    extern "C" {
        fn clock_gettime(clock: i32, time: *mut Time) -> i32;
    }
    const PROCESS: i32 = 2;
    let mut time = Time { seconds: 0, nanoseconds: 0 };
    unsafe { clock_gettime(PROCESS, &mut time) };
    time.seconds as u64 * 1_000_000_000 + time.nanoseconds as u64
}

/// The kilobytes in a line of /proc/self/status.
pub fn memory(line: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let found = status.lines().find_map(|l| l.strip_prefix(line)?.strip_prefix(':'));
    found.and_then(|l| l.split_whitespace().next()?.parse().ok()).unwrap_or(0)
}

/// Resets the peak memory of the process to the present memory, and returns it in kilobytes.
pub fn forget_peak() -> u64 {
    let _ = fs::write("/proc/self/clear_refs", "5");
    memory("VmHWM")
}
