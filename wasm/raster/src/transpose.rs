//! Turns rows of a frame into the lanes of a band and back.
//!
//! An image of `c` channels is one of `c · width` values a row: lanes come out pixel by pixel, channel by channel.

use crate::walk::{Lane, ROWS};

type Block = [Lane; ROWS];

/// Reads columns `first..` of the band at row `top` of an image of `stride` values a row; rows below the image keep theirs.
pub fn read(image: &[f32], stride: usize, top: usize, first: usize, lanes: &mut [Lane]) {
    let rows = &image[top * stride..image.len().min((top + ROWS) * stride)];
    let (blocks, rest) = lanes.as_chunks_mut::<ROWS>();
    let tail = blocks.len() * ROWS;
    if rows.len() == ROWS * stride {
        for (i, block) in blocks.iter_mut().enumerate() {
            for (row, line) in rows.chunks_exact(stride).enumerate() {
                block[row].copy_from_slice(&line[first + i * ROWS..][..ROWS]);
            }
            transpose(block);
        }
        return scatter(rows, stride, first + tail, rest);
    }
    scatter(rows, stride, first, lanes);
}

/// Writes a band's lanes into `rows` of an image, as many rows as there are.
pub fn write(lanes: &[Lane], stride: usize, rows: &mut [f32]) {
    for (i, chunk) in lanes.chunks(ROWS).enumerate() {
        let mut block = [[0.0; ROWS]; ROWS];
        block[..chunk.len()].copy_from_slice(chunk);
        transpose(&mut block);
        for (line, values) in rows.chunks_exact_mut(stride).zip(&block) {
            line[i * ROWS..][..chunk.len()].copy_from_slice(&values[..chunk.len()]);
        }
    }
}

/// The plain way, for the ends of rows and the last band: values of columns `first..` one by one.
fn scatter(rows: &[f32], stride: usize, first: usize, lanes: &mut [Lane]) {
    for (row, line) in rows.chunks_exact(stride).enumerate() {
        for (lane, value) in lanes.iter_mut().zip(&line[first..]) {
            lane[row] = *value;
        }
    }
}

/// Swaps the off-diagonal halves of ever smaller squares: constant shuffles that become vector instructions.
fn transpose(block: &mut Block) {
    swap::<8>(block);
    swap::<4>(block);
    swap::<2>(block);
    swap::<1>(block);
}

fn swap<const HALF: usize>(block: &mut Block) {
    for i in (0..ROWS).filter(|i| i & HALF == 0) {
        let (a, b) = (block[i], block[i + HALF]);
        for l in 0..ROWS {
            let upper = l & HALF == 0;
            block[i][l] = if upper { a[l] } else { b[l - HALF] };
            block[i + HALF][l] = if upper { a[l + HALF] } else { b[l] };
        }
    }
}
