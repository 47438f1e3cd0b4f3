//! Turns rows of a frame into the lanes of a band and back.
//!
//! An image of `c` channels is one of `c · width` values a row: lanes come out pixel by pixel, channel by channel.

use crate::lane::{Lane, ROWS};

type Block = [[f32; ROWS]; ROWS];

/// Reads columns `first..` of the band at row `top` of an image of `stride` values a row; rows below the image read as zero.
pub fn read(image: &[f32], stride: usize, top: usize, first: usize, lanes: &mut [Lane]) {
    let rows = &image[top * stride..image.len().min((top + ROWS) * stride)];
    for (i, chunk) in lanes.chunks_mut(ROWS).enumerate() {
        let mut block = [[0.0; ROWS]; ROWS];
        for (line, values) in rows.chunks_exact(stride).zip(&mut block) {
            values[..chunk.len()].copy_from_slice(&line[first + i * ROWS..][..chunk.len()]);
        }
        transpose(&mut block);
        for (lane, values) in chunk.iter_mut().zip(block) {
            *lane = Lane::from(values);
        }
    }
}

/// Writes a band's lanes into `rows` of an image, as many rows as there are.
pub fn write(lanes: &[Lane], stride: usize, rows: &mut [f32]) {
    for (i, chunk) in lanes.chunks(ROWS).enumerate() {
        let mut block = [[0.0; ROWS]; ROWS];
        for (values, lane) in block.iter_mut().zip(chunk) {
            *values = lane.to_array();
        }
        transpose(&mut block);
        for (line, values) in rows.chunks_exact_mut(stride).zip(&block) {
            line[i * ROWS..][..chunk.len()].copy_from_slice(&values[..chunk.len()]);
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
