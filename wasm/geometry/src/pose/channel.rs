//! The articulators of a pose and their ranges.

use crate::error::RigError;
use crate::opening::N_LANDMARKS;
use crate::point::Point;

/// One articulator; the discriminant is its place in `Pose::articulators`. Left and right are as seen in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    Jaw,
    Width,
    Round,
    UpperRaise,
    LowerRaise,
    Press,
    TongueTip,
    Smile,
    BlinkLeft,
    BlinkRight,
    BrowLeft,
    BrowRight,
    /// Positive looks to the image's right.
    GazeX,
    /// Positive looks down.
    GazeY,
    /// Degrees; positive turns the face to the image's right.
    Yaw,
    /// Degrees; positive nods down.
    Pitch,
    /// Degrees; positive tilts clockwise on screen.
    Roll,
    /// Share of the way from the portrait's rest to a neutral face, whose lips are closed: where tracks start from.
    Neutral,
}

pub const N_CHANNELS: usize = 18;

/// Name, least and greatest value of each channel, in the order of `Channel`.
pub const CHANNELS: [(&str, f64, f64); N_CHANNELS] = [
    ("jaw", 0.0, 1.0),
    ("width", -1.0, 1.0),
    ("round", 0.0, 1.0),
    ("upper_raise", 0.0, 1.0),
    ("lower_raise", 0.0, 1.0),
    ("press", 0.0, 1.0),
    ("tongue_tip", 0.0, 1.0),
    ("smile", -1.0, 1.0),
    ("blink_left", -0.3, 1.0),
    ("blink_right", -0.3, 1.0),
    ("brow_left", -1.0, 1.0),
    ("brow_right", -1.0, 1.0),
    ("gaze_x", -1.0, 1.0),
    ("gaze_y", -1.0, 1.0),
    ("yaw", -25.0, 25.0),
    ("pitch", -15.0, 15.0),
    ("roll", -30.0, 30.0),
    ("neutral", 0.0, 1.0),
];

/// Articulator values and landmark offsets (outer-eye distances, from rest); both add up.
#[derive(Clone, Debug)]
pub struct Pose {
    pub articulators: [f64; N_CHANNELS],
    pub offsets: Option<Box<[Point; N_LANDMARKS]>>,
}

impl Default for Pose {
    fn default() -> Self {
        Self { articulators: [0.0; N_CHANNELS], offsets: None }
    }
}

impl Pose {
    /// Pose from flat arrays; values beyond a channel's range are brought to its nearer end.
    ///
    /// # Errors
    /// `RigError::Pose` when a length is wrong or a value is not finite. An empty `offsets` means none.
    pub fn from_flat(articulators: &[f64], offsets: &[f64]) -> Result<Self, RigError> {
        if articulators.len() != N_CHANNELS {
            return Err(RigError::Pose(format!("{} articulators given, {N_CHANNELS} wanted", articulators.len())));
        }
        if articulators.iter().chain(offsets).any(|value| !value.is_finite()) {
            return Err(RigError::Pose("a pose value is not a finite number".into()));
        }
        let mut pose = Self::default();
        for (value, (&given, (_, least, greatest))) in
            pose.articulators.iter_mut().zip(articulators.iter().zip(CHANNELS))
        {
            *value = given.clamp(least, greatest);
        }
        if !offsets.is_empty() {
            let points: [Point; N_LANDMARKS] = crate::point::from_flat(offsets).try_into().map_err(|_| {
                RigError::Pose(format!("{} offset numbers given, {} wanted", offsets.len(), 2 * N_LANDMARKS))
            })?;
            pose.offsets = Some(Box::new(points));
        }
        Ok(pose)
    }

    /// Pose of a few channels, all others at rest.
    #[must_use]
    pub fn of(channels: &[(Channel, f64)]) -> Self {
        let mut pose = Self::default();
        for &(channel, value) in channels {
            pose.articulators[channel as usize] = value;
        }
        pose
    }

    #[must_use]
    pub fn value(&self, channel: Channel) -> f64 {
        self.articulators[channel as usize]
    }
}
