//! areas FILE [EPSILON]: the offsets of many small contours. FILE contains one record for each contour, of little-endian numbers
//! of eight bytes: the number of vertices (an integer), the offset D in mm, then x y bulge for each vertex. D > 0 is outwards if
//! the contour is counter-clockwise. The program prints a line for each contour: the area of its offset, the length, and the
//! numbers of closed loops and of open polyarcs. EPSILON is the distance in mm below which two points count as one, by default
//! 1e-5. The offset may be nearer to the contour than D by ten times EPSILON.

use cavalier::{measures, number, vertices};
use cavalier_contours::polyline::{PlineOffsetOptions, PlineSource};
use std::fs::File;
use std::io::{BufReader, BufWriter, ErrorKind, Write};

fn main() -> std::io::Result<()> {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("areas FILE [EPSILON]");
        std::process::exit(2);
    };
    let epsilon = std::env::args().nth(2).map(|e| e.parse().expect("a distance in mm"));
    let mut options = PlineOffsetOptions::default();
    options.pos_equal_eps = epsilon.unwrap_or(options.pos_equal_eps);
    options.offset_dist_eps = epsilon.map_or(options.offset_dist_eps, |e: f64| 10.0 * e);
    let mut file = BufReader::new(File::open(path)?);
    let mut out = BufWriter::new(std::io::stdout());
    while let Some(count) = number(&mut file)? {
        let distance = f64::from_le_bytes(number(&mut file)?.ok_or(ErrorKind::UnexpectedEof)?);
        let source = vertices(&mut file, u64::from_le_bytes(count) as usize)?;
        let (mut area, mut length, mut open) = (0.0, 0.0, 0);
        let result = source.parallel_offset_opt(-distance, &options);
        for piece in &result {
            let (a, l) = measures(piece);
            area += a;
            length += l;
            open += usize::from(!piece.is_closed());
        }
        writeln!(out, "{area:?} {length:?} {} {open}", result.len() - open)?;
    }
    Ok(())
}
