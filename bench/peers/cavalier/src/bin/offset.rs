//! offset SMALL FILE D RUNS BATCHES: the offset of one closed contour by D mm (outwards when it is counter-clockwise), RUNS times
//! in each batch. FILE contains little-endian doubles, x y bulge for each vertex. The program prints for every batch the
//! nanoseconds of processor time of one run, then the result of the last run and the rise of peak memory in the first run. Before
//! that it offsets the contour of SMALL a hundred times, so that the code and the memory that the library keeps are allocated.

use cavalier::{contour, forget_peak, measures, memory, processor};
use cavalier_contours::polyline::PlineSource;
use std::hint::black_box;

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, small, file, distance, runs, batches] = arguments.as_slice() else {
        eprintln!("offset SMALL FILE D RUNS BATCHES");
        std::process::exit(2);
    };
    let distance: f64 = distance.parse().expect("a distance in mm");
    let runs: u64 = runs.parse().expect("a number of runs");
    let batches: u64 = batches.parse().expect("a number of batches");
    let begin = contour(small)?;
    for _ in 0..100 {
        black_box(begin.parallel_offset(-distance));
    }
    let source = contour(file)?;

    // In cavalier_contours a positive distance is to the left.
    let offset = || black_box(&source).parallel_offset(black_box(-distance));
    let before = forget_peak();
    let begin = processor();
    let mut result = offset();
    let first = processor() - begin;
    let memory = memory("VmHWM") - before;
    if batches == 0 {
        println!("run {first}");
    }
    for _ in 0..batches {
        let begin = processor();
        for _ in 0..runs {
            result = offset();
        }
        println!("run {}", (processor() - begin) / runs);
    }
    let (mut area, mut length) = (0.0, 0.0);
    for loop_ in &result {
        let (a, l) = measures(loop_);
        area += a;
        length += l;
    }
    println!("area {area:?}\nlength {length:?}\nloops {}", result.iter().filter(|l| l.is_closed()).count());
    println!("open {}", result.iter().filter(|l| !l.is_closed()).count());
    println!("vertices {}\nmemory {}", result.iter().map(|l| l.vertex_count()).sum::<usize>(), memory * 1024);
    Ok(())
}
