//! The one error of the rig.

use std::fmt;

/// Why no rig can be built or posed; each message names the value and the limit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RigError {
    Landmarks(String),
    Scene(String),
    Pose(String),
}

impl RigError {
    /// Stable code for the borders.
    #[must_use]
    pub const fn code(&self) -> &'static str {
        match self {
            Self::Landmarks(_) => "bad_landmarks",
            Self::Scene(_) => "bad_scene",
            Self::Pose(_) => "bad_pose",
        }
    }
}

impl fmt::Display for RigError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Landmarks(message) | Self::Scene(message) | Self::Pose(message) => formatter.write_str(message),
        }
    }
}

impl std::error::Error for RigError {}
