//! Reads written files back and plays them as a browser does: every frame lies within the tolerance.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::TAU;

use super::*;
use crate::point::Point;

const N_FRAMES: usize = 61;
const DURATION: f64 = 2.4;
const HEAD: [Point; 3] = [Point::new(150.0, 120.0), Point::new(250.0, 122.0), Point::new(200.0, 180.0)];

/// Back and body rest, the head turns and shifts, its mouth speaks.
struct Nodding;

impl Nodding {
    const PICTURE_PATHS: usize = 14;

    fn picture(fills: impl Fn(usize) -> Fill) -> Picture {
        Picture {
            width: 400.0,
            height: 300.0,
            canvas: [250, 240, 230],
            n_back: 2,
            n_fore: 8,
            fills: (0..Self::PICTURE_PATHS).map(fills).collect(),
            openings: vec![0, 1, 2, 2],
        }
    }

    fn blob(centre: Point, radius: f64) -> Vec<Point> {
        let wave = |i: usize| radius * (1.0 + 0.2 * (i as f64 * 2.3).sin());
        let turn = |i: usize| Point::new((i as f64 / 12.0 * TAU).cos(), (i as f64 / 12.0 * TAU).sin());
        (0..12).map(|i| centre + turn(i) * wave(i)).collect()
    }

    fn nod(frame: usize, p: Point) -> Point {
        let t = frame as f64 / (N_FRAMES - 1) as f64;
        let angle = 0.25 * (t * TAU).sin();
        let turned = (p - Point::new(200.0, 260.0)).complex_mul(Point::new(angle.cos(), angle.sin()));
        turned + Point::new(200.0 + 12.0 * (t * 2.0 * TAU).sin(), 260.0)
    }

    fn speak(frame: usize, points: Vec<Point>) -> Vec<Point> {
        let gape = (frame as f64 * 0.9).sin().abs() * 9.0;
        let moved = points.into_iter().map(|p| p + Point::new(0.0, if p.y > 200.0 { gape } else { 0.0 }));
        moved.map(|p| Self::nod(frame, p)).collect()
    }
}

impl Motion for Nodding {
    fn n_frames(&self) -> usize {
        N_FRAMES
    }

    fn path(&self, path: usize, frame: usize) -> Vec<Point> {
        let rest = Self::blob(Point::new(60.0 + 20.0 * path as f64, 150.0), 40.0);
        match path {
            0..4 => rest,
            4..9 => rest.into_iter().map(|p| Self::nod(frame, p)).collect(),
            _ => Self::speak(frame, Self::blob(Point::new(200.0, 205.0), 25.0)),
        }
    }

    fn opening(&self, opening: usize, frame: usize) -> Vec<Point> {
        Self::speak(frame, Self::blob(Point::new(160.0 + 40.0 * opening as f64, 200.0), 10.0))
    }

    fn axis(&self, path: usize, frame: usize) -> [Point; 2] {
        let outline = self.path(path, frame);
        [outline[0], outline[6]]
    }

    fn head(&self, frame: usize) -> Vec<Point> {
        HEAD.map(|p| Self::nod(frame, p)).to_vec()
    }
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    tag.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split_once('"')).map(|(value, _)| value)
}

fn numbers(text: &str) -> Vec<f64> {
    let spaced = text.replace('-', " -").replace(['m', 'c', 'z', ','], " ");
    spaced.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

/// Values of an animation at the share `t` of its duration.
fn play(tag: &str, t: f64) -> Vec<f64> {
    let times: Vec<f64> = attribute(tag, "keyTimes").unwrap().split(';').map(|time| time.parse().unwrap()).collect();
    let values: Vec<Vec<f64>> = attribute(tag, "values").unwrap().split(';').map(numbers).collect();
    assert_eq!((times[0], *times.last().unwrap(), times.len()), (0.0, 1.0, values.len()));
    let after = times.partition_point(|time| *time < t).clamp(1, times.len() - 1);
    let share = (t - times[after - 1]) / (times[after] - times[after - 1]);
    values[after - 1].iter().zip(&values[after]).map(|(a, b)| a + (b - a) * share).collect()
}

/// Absolute control points, in steps, of the relative numbers of a closed chain.
fn outline(numbers: &[f64]) -> Vec<Point> {
    let mut start = Point::new(numbers[0], numbers[1]);
    let mut points = Vec::new();
    for segment in numbers[2..].chunks(6) {
        points.extend([start, start + Point::new(segment[0], segment[1]), start + Point::new(segment[2], segment[3])]);
        start += Point::new(segment[4], segment[5]);
    }
    assert!(start.distance(points[0]) < 1e-6, "open outline");
    points
}

/// What a group makes of a point: turned, shifted, scaled.
#[derive(Clone, Copy)]
struct Group {
    turn: Point,
    shift: Point,
    scale: f64,
}

impl Group {
    const REST: Self = Self { turn: Point::new(1.0, 0.0), shift: Point::ZERO, scale: 1.0 };

    fn place(self, p: Point) -> Point {
        (p.complex_mul(self.turn) + self.shift) * self.scale
    }
}

/// Outlines of all `<path>` elements, clips included, in document order and portrait pixels, at the share `t`.
fn played(svg: &str, t: f64) -> Vec<Vec<Point>> {
    let mut outlines: Vec<Vec<Point>> = Vec::new();
    let mut groups: Vec<Group> = Vec::new();
    let mut rest = Vec::new();
    let placed = |groups: &[Group], numbers: &[f64]| -> Vec<Point> {
        let place = |p| groups.iter().rev().fold(p, |p, group| group.place(p));
        outline(numbers).into_iter().map(place).collect()
    };
    for tag in svg.split('<') {
        if tag.starts_with("g ") {
            let scale = attribute(tag, "transform").and_then(|text| text.strip_prefix("scale("));
            let scale = scale.map_or(1.0, |text| text.trim_end_matches(')').parse().unwrap());
            groups.push(Group { scale, ..Group::REST });
        } else if tag.starts_with("/g>") {
            groups.pop();
        } else if tag.contains("type=\"translate\"") {
            let shift = play(tag, t);
            groups.last_mut().unwrap().shift = Point::new(shift[0], shift[1]);
        } else if tag.contains("type=\"rotate\"") {
            let angle = play(tag, t)[0].to_radians();
            groups.last_mut().unwrap().turn = Point::new(angle.cos(), angle.sin());
        } else if tag.starts_with("path ") {
            rest = numbers(attribute(tag, "d").unwrap());
            outlines.push(placed(&groups, &rest));
        } else if tag.starts_with("animate attributeName=\"d\"") {
            let sum: Vec<f64> = play(tag, t).iter().zip(&rest).map(|(a, b)| a + b).collect();
            *outlines.last_mut().unwrap() = placed(&groups, &sum);
        }
    }
    outlines
}

/// Outlines of a frame in the order in which a document has them.
fn wanted(frame: usize) -> Vec<Vec<Point>> {
    let motion = &Nodding;
    let clipped = [(0, 10..11), (1, 11..12), (2, 12..14)];
    let local = clipped.into_iter().flat_map(|(opening, paths)| {
        std::iter::once(motion.opening(opening, frame)).chain(paths.map(move |path| motion.path(path, frame)))
    });
    (0..10).map(|path| motion.path(path, frame)).chain(local).collect()
}

fn solid(_: usize) -> Fill {
    Fill::Solid(Stop { colour: [1, 2, 3], opacity: 0.5 })
}

fn written(tolerance: f64, fills: impl Fn(usize) -> Fill) -> String {
    let options = Options { duration: DURATION, tolerance, looped: true, title: "a \u{1}< b", description: "" };
    write(&Nodding::picture(fills), &Nodding, &options)
}

#[test]
fn every_frame_is_reproduced_within_the_tolerance() {
    for tolerance in [0.2, 0.5, 2.0] {
        let svg = written(tolerance, solid);
        for frame in 0..N_FRAMES {
            let outlines = played(&svg, frame as f64 / (N_FRAMES - 1) as f64);
            let expected = wanted(frame);
            assert_eq!(outlines.len(), expected.len());
            for (outline, points) in outlines.iter().zip(&expected) {
                let miss = outline.iter().zip(points).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
                assert!(miss <= tolerance, "frame {frame} is {miss} px off; the tolerance is {tolerance} px");
            }
        }
    }
}

#[test]
fn what_moves_with_the_head_alone_has_no_keyframes() {
    let svg = written(0.5, solid);
    // paths 0 to 3 rest, 4 to 8 only nod
    let speaking = svg.matches("attributeName=\"d\"").count();
    assert_eq!(speaking, 1 + 4 + 3, "path 9, local paths 10 to 13, three openings");
}

#[test]
fn gradients_move_with_their_path() {
    let stop = Stop { colour: [9, 9, 9], opacity: 1.0 };
    let svg = written(0.5, |_| Fill::Linear([stop; 3]));
    assert_eq!(svg.matches("<linearGradient").count(), Nodding::PICTURE_PATHS);
    // the ends of path 9's gradient straddle the line below which the face speaks
    let (_, nine) = svg.split_once("id=\"g9\"").unwrap();
    let tags: Vec<&str> = nine.split_once("</linearGradient>").unwrap().0.split('<').collect();
    let ends: Vec<&&str> = tags.iter().filter(|tag| tag.starts_with("animate ")).collect();
    assert_eq!(ends.len(), 4);
}

#[test]
fn text_is_escaped() {
    assert!(written(0.5, solid).contains(">a &lt; b</title>"));
}
