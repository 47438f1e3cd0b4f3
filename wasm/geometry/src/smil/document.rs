//! Puts the elements of an animated SVG together.

use std::fmt::Write as _;

use super::Options;
use super::elements::{Clock, Reference, Writer, decimal, hex};
use super::picture::{Motion, Picture};
use super::reference::cheapest_references;

/// One animated SVG. `motion` has at least one frame, and as many paths as `picture` has fills.
#[must_use]
pub fn write<M: Motion>(picture: &Picture, motion: &M, options: &Options) -> String {
    let clock = Clock { n_frames: motion.n_frames(), duration: options.duration, looped: options.looped };
    let writer = Writer::new(picture, motion, clock, options.tolerance);
    let (width, height) = (decimal(picture.width, 2), decimal(picture.height, 2));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\">\n\
         <title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
        escape(options.title),
        escape(options.description),
        hex(picture.canvas),
    );
    let clips = picture.clipped();
    push_layer(&mut svg, "back", picture.back().map(|path| writer.path(path, Reference::Picture)), &writer);
    push_layer(
        &mut svg,
        "fore",
        runs(&writer, picture.fore().len(), |i, reference| writer.path(picture.fore().start + i, reference)),
        &writer,
    );
    push_layer(
        &mut svg,
        "local",
        runs(&writer, clips.len(), |i, reference| {
            let (opening, paths) = clips[i].clone();
            writer.clipped(i, opening, paths, reference)
        }),
        &writer,
    );
    svg + "</svg>\n"
}

fn push_layer<M>(svg: &mut String, name: &str, elements: impl IntoIterator<Item = String>, writer: &Writer<M>) {
    _ = writeln!(svg, r#"<g id="{name}" transform="scale({})">"#, decimal(writer.step, 9));
    svg.extend(elements);
    svg.push_str("</g>\n");
}

/// Texts of `n` elements, those in the head's frame of reference wrapped, run by run, in a group that moves with it.
fn runs<M: Motion>(writer: &Writer<M>, n: usize, element: impl Fn(usize, Reference) -> String) -> Vec<String> {
    let Some(head) = &writer.head else {
        return (0..n).map(|i| element(i, Reference::Picture)).collect();
    };
    let both: Vec<[String; 2]> =
        (0..n).map(|i| [element(i, Reference::Picture), element(i, Reference::Head)]).collect();
    let (open, close) = (writer.moving_group(head), "</g>\n");
    let bytes: Vec<[usize; 2]> = both.iter().map(|texts| [texts[0].len(), texts[1].len()]).collect();
    let references = cheapest_references(&bytes, open.len() + close.len());
    let mut written = Vec::with_capacity(n);
    let mut inside = false;
    for ([in_picture, in_head], reference) in both.into_iter().zip(references) {
        let moves = reference == Reference::Head;
        match (inside, moves) {
            (false, true) => written.push(open.clone()),
            (true, false) => written.push(close.into()),
            _ => {}
        }
        inside = moves;
        written.push(if moves { in_head } else { in_picture });
    }
    if inside {
        written.push(close.into());
    }
    written
}

/// Text of an element; characters that no XML document may hold are left out.
fn escape(text: &str) -> String {
    let text: String =
        text.chars().filter(|c| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..)).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
