//! Writes one path, opening or gradient with its animation, in either frame of reference.

use std::fmt::Write as _;
use std::ops::Range;

use super::keyframes::{Trajectory, keyframes, largest_move};
use super::path_data::{difference, join, path_data, relative_numbers, whole};
use super::picture::{Fill, Motion, Picture, Stop};
use super::rigid::{RigidMotion, rigid_motion};
use crate::point::Point;

/// What moves less than this, in portrait pixels, is not animated: nobody sees it.
pub const STILL: f64 = 0.35;

/// Steps of a written coordinate per tolerance: rounding takes a sixth of the tolerance, keyframes get the rest.
const STEPS_PER_TOLERANCE: f64 = 4.0;

/// What coordinates and movements are relative to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    Picture,
    Head,
}

/// Everything that the elements of one document share.
pub struct Writer<'a, M> {
    pub picture: &'a Picture,
    pub motion: &'a M,
    pub clock: Clock,
    /// Portrait pixels per written unit.
    pub step: f64,
    pub tolerance: f64,
    pub head: Option<RigidMotion>,
}

/// Timing attributes of all animations.
#[derive(Clone, Copy)]
pub struct Clock {
    pub n_frames: usize,
    pub duration: f64,
    pub looped: bool,
}

impl Clock {
    /// `keyTimes`, `dur` and what happens at the end, for frames `keys`.
    pub fn attributes(self, keys: &[usize]) -> String {
        let last = self.n_frames.saturating_sub(1).max(1);
        let digits = last.to_string().len() + 2; // a two-hundredth of a frame at worst
        let times: Vec<String> = keys.iter().map(|key| decimal(*key as f64 / last as f64, digits)).collect();
        let end = if self.looped { r#"repeatCount="indefinite""# } else { r#"fill="freeze""# };
        let duration = decimal(self.duration, 4);
        format!(r#"dur="{duration}s" {end} keyTimes="{}""#, times.join(";"))
    }
}

/// Shortest decimal of at most `digits` places: `.5`, `12`, `0`.
pub fn decimal(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    match text {
        "0" | "-0" => "0".into(),
        _ => text.strip_prefix("0").filter(|rest| rest.starts_with('.')).unwrap_or(text).into(),
    }
}

impl<'a, M: Motion> Writer<'a, M> {
    pub fn new(picture: &'a Picture, motion: &'a M, clock: Clock, tolerance: f64) -> Self {
        let step = tolerance / STEPS_PER_TOLERANCE;
        let head = (0..motion.n_frames()).map(|frame| motion.head(frame)).collect();
        let head = rigid_motion(&head, step, tolerance, STILL);
        Self { picture, motion, clock, step, tolerance, head }
    }

    /// `<path>` of path `path`, preceded by its gradient if it has one, in a moving group of its own if that is shorter.
    pub fn path(&self, path: usize, reference: Reference) -> String {
        let outline = self.trajectory(reference, |frame| self.motion.path(path, frame));
        let axis = match self.picture.fills[path] {
            Fill::Solid(_) => Trajectory::new(),
            Fill::Linear(_) => self.trajectory(reference, |frame| self.motion.axis(path, frame).to_vec()),
        };
        let plain = self.painted(path, &outline, &axis);
        if self.keys(&outline).is_none() {
            return plain;
        }
        let Some(own) = rigid_motion(&outline, self.step, self.tolerance, STILL) else { return plain };
        let inside = self.painted(path, &self.relative(&outline, &own), &self.relative(&axis, &own));
        let grouped = format!("{}{inside}</g>\n", self.moving_group(&own));
        if grouped.len() < plain.len() { grouped } else { plain }
    }

    /// `<clipPath id="c{id}">` of an opening and the paths that it clips.
    pub fn clipped(&self, id: usize, opening: usize, paths: Range<usize>, reference: Reference) -> String {
        let outline = self.trajectory(reference, |frame| self.motion.opening(opening, frame));
        let clip = self.outline(&outline, "");
        let paths: String = paths.map(|path| self.path(path, reference)).collect();
        format!("<clipPath id=\"c{id}\">{clip}</clipPath>\n<g clip-path=\"url(#c{id})\">\n{paths}</g>\n")
    }

    /// Opening tag of a group with its motion, without its contents and end tag.
    pub fn moving_group(&self, motion: &RigidMotion) -> String {
        let timing = self.clock.attributes(&motion.keys);
        let shifts = values(motion.shifts.iter().map(|shift| join(shift)));
        let angles = values(motion.angles.iter().map(|angle| decimal(*angle as f64 / 100.0, 2)));
        let pivot = join(&motion.pivot);
        let animate = r#"<animateTransform attributeName="transform""#;
        format!(
            "<g transform=\"translate({pivot})\">\n{animate} type=\"translate\" {timing} values=\"{shifts}\"/>\n\
             {animate} type=\"rotate\" additive=\"sum\" {timing} values=\"{angles}\"/>\n"
        )
    }

    fn painted(&self, path: usize, outline: &Trajectory, axis: &Trajectory) -> String {
        let (gradient, paint) = match self.picture.fills[path] {
            Fill::Solid(stop) => {
                let (colour, opacity) = (hex(stop.colour), opacity("fill", stop.opacity));
                (String::new(), format!(r#"fill="{colour}"{opacity} "#))
            }
            Fill::Linear(stops) => (self.gradient(path, stops, axis), format!(r#"fill="url(#g{path})" "#)),
        };
        format!("{gradient}{}\n", self.outline(outline, &paint))
    }

    fn trajectory(&self, reference: Reference, points: impl Fn(usize) -> Vec<Point>) -> Trajectory {
        let frames = (0..self.motion.n_frames()).map(points).collect();
        match (reference, &self.head) {
            (Reference::Head, Some(head)) => self.relative(&frames, head),
            _ => frames,
        }
    }

    /// The trajectory as seen from what moves by `motion`.
    fn relative(&self, trajectory: &Trajectory, motion: &RigidMotion) -> Trajectory {
        let placements = (0..).map(|frame| motion.placement(frame, self.step));
        let frames = trajectory.iter().zip(placements);
        frames.map(|(points, placement)| points.iter().map(|&p| placement.to_local(p)).collect()).collect()
    }

    /// Frames to write of a trajectory; none when it rests.
    fn keys(&self, trajectory: &Trajectory) -> Option<Vec<usize>> {
        let rounding = self.step * std::f64::consts::FRAC_1_SQRT_2;
        let moves = largest_move(trajectory) > STILL.min(self.tolerance - rounding);
        moves.then(|| keyframes(trajectory, self.tolerance - rounding))
    }

    fn outline(&self, trajectory: &Trajectory, attributes: &str) -> String {
        let rest = relative_numbers(&trajectory[0], self.step);
        let data = path_data(&rest);
        let Some(keys) = self.keys(trajectory) else {
            return format!(r#"<path {attributes}d="{data}"/>"#);
        };
        let timing = self.clock.attributes(&keys);
        let moves = keys.iter().map(|&key| difference(&relative_numbers(&trajectory[key], self.step), &rest));
        let values = values(moves.map(|numbers| path_data(&numbers)));
        format!(
            r#"<path {attributes}d="{data}"><animate attributeName="d" additive="sum" {timing} values="{values}"/></path>"#
        )
    }

    fn gradient(&self, path: usize, stops: [Stop; 3], axis: &Trajectory) -> String {
        let rest = axis[0].iter().flat_map(|p| [whole(p.x / self.step), whole(p.y / self.step)]);
        let mut text = format!(r#"<linearGradient id="g{path}" gradientUnits="userSpaceOnUse""#);
        let names = ["x1", "y1", "x2", "y2"];
        names.iter().zip(rest).for_each(|(name, value)| _ = write!(text, r#" {name}="{value}""#));
        text.push('>');
        if let Some(keys) = self.keys(axis) {
            let timing = self.clock.attributes(&keys);
            for (i, name) in names.iter().enumerate() {
                let at = |key: &usize| {
                    let end = axis[*key][i / 2];
                    whole(if i % 2 == 0 { end.x } else { end.y } / self.step).to_string()
                };
                let values = values(keys.iter().map(at));
                _ = write!(text, r#"<animate attributeName="{name}" {timing} values="{values}"/>"#);
            }
        }
        for (offset, stop) in ["0", ".5", "1"].iter().zip(stops) {
            let (colour, opacity) = (hex(stop.colour), opacity("stop", stop.opacity));
            _ = write!(text, r#"<stop offset="{offset}" stop-color="{colour}"{opacity}/>"#);
        }
        text + "</linearGradient>"
    }
}

fn values(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(";")
}

pub fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn opacity(kind: &str, value: f64) -> String {
    if value >= 1.0 { String::new() } else { format!(r#" {kind}-opacity="{}""#, decimal(value, 3)) }
}
