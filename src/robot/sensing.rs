//! How well a robot sees and remembers, as data: the named presets in `assets/sensing/*.ron`.
//!
//! Lengths are metres, times seconds, angles degrees; noise values are standard deviations.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all, check_count};

/// Eyes, localisation, odometry and memory of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensing {
    /// Its name for people.
    pub name: String,
    /// What the robot sees.
    pub eyes: Eyes,
    /// How long beliefs last.
    pub memory: MemorySpans,
}

/// Perfect sensing is a switch: everything, at once, without noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Eyes {
    /// The truth, at every tick.
    Perfect,
    /// A camera and what goes with it, as a model of its errors.
    Real { camera: Camera, localisation: Localisation, odometry: OdometryNoise },
    /// Pictures, drawn of the truth and cut by colour as a file among the cameras has been calibrated. Landmarks in them are all
    /// that tells the robot its place. What the robot believes of the errors of what it sees is given as the model of a camera.
    Images {
        calibration: String,
        camera: Camera,
        odometry: OdometryNoise,
        #[serde(default)]
        put_down: PlaceError,
    },
}

impl Eyes {
    /// The errors of what the camera shows, if it is not perfect.
    pub fn camera(&self) -> Option<&Camera> {
        match self {
            Eyes::Perfect => None,
            Eyes::Real { camera, .. } | Eyes::Images { camera, .. } => Some(camera),
        }
    }

    /// The errors of dead reckoning, if it is not perfect.
    pub fn odometry(&self) -> Option<&OdometryNoise> {
        match self {
            Eyes::Perfect => None,
            Eyes::Real { odometry, .. } | Eyes::Images { odometry, .. } => Some(odometry),
        }
    }

    /// How well a robot knows its place after people have put it down.
    pub fn put_down(&self) -> PlaceError {
        match self {
            Eyes::Perfect => PlaceError::default(),
            Eyes::Real { localisation, .. } => localisation.put_down,
            Eyes::Images { put_down, .. } => *put_down,
        }
    }

    /// The file among the cameras by which pictures are cut, if there are pictures.
    pub fn calibration(&self) -> Option<&str> {
        match self {
            Eyes::Images { calibration, .. } => Some(calibration),
            Eyes::Perfect | Eyes::Real { .. } => None,
        }
    }
}

/// A colour-blob camera that looks ahead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Degrees, from edge to edge.
    pub field_of_view: f32,
    /// Frames a second.
    pub frame_hz: f32,
    /// From the shutter to the percept.
    pub latency: f32,
    /// Farthest usable reading of the ball.
    pub ball_range: f32,
    /// Farthest usable reading of a robot's marker.
    pub robot_range: f32,
    /// Noise of a range r is this times r², 1/m: a pixel means more metres farther away.
    pub range_noise: f32,
    /// Added to the above, m.
    pub range_floor: f32,
    /// Standard deviation, degrees.
    pub bearing_noise: f32,
    /// Chance that a frame shows what is in full view and near; falls to 0.3 of it at the end of the range.
    pub detection: f32,
    /// Least visible share of a thing that is still recognised.
    pub visible_share: f32,
    /// Chance per frame to take something else for the ball.
    pub false_positive: f32,
    /// Chance per sighting of a robot to take its marker for that of the other team.
    #[serde(default)]
    pub wrong_team: f32,
}

/// Self-localisation: fixes that are wrong by a slowly drifting amount, and what brings them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Localisation {
    /// Of each coordinate.
    pub position: f32,
    /// Standard deviation, degrees.
    pub heading: f32,
    /// How long an error lasts: the time in which it falls to a third, left alone.
    pub drift_time: f32,
    /// Mean time between two jumps to another error.
    pub jump_time: f32,
    /// What a fix needs. Without it every frame brings one, and a fix far off the belief is believed at once.
    #[serde(default)]
    pub landmarks: Option<Landmarks>,
    /// How well a robot knows its place after people have put it down.
    #[serde(default)]
    pub put_down: PlaceError,
}

/// What a robot finds its place by, and how fast.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Landmarks {
    /// Farthest goal post that is recognised.
    pub posts: f32,
    /// Farthest beacon that is recognised, where a pitch has beacons.
    pub beacons: f32,
    /// Farthest line or foot of a wall that is recognised.
    pub lines: f32,
    /// The share of a fix that one post or beacon gives; two give all of it.
    pub one: f32,
    /// The share of a fix that lines give, in addition.
    pub line: f32,
    /// While a ball nearer than this is in view, the camera looks down at it and shows neither posts nor beacons.
    pub looks_down: f32,
    /// How long beliefs take to follow full fixes: the time in which an error falls to a third.
    pub settle: f32,
}

/// Standard deviations of what a robot takes its pose to be; nothing by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceError {
    /// Of each coordinate.
    pub position: f32,
    /// degrees
    pub heading: f32,
}

/// Dead reckoning from the wheels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OdometryNoise {
    /// After one metre; grows with the root of the distance.
    pub distance: f32,
    /// After half a metre; grows with the root of the distance, degrees.
    pub heading: f32,
    /// What is reckoned with.
    #[serde(default)]
    pub from: OdometrySource,
}

/// What a robot's odometry reckons with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum OdometrySource {
    /// The robot's true motion: a robot that is blocked or pushed knows it. Sliding sideways is no motion of wheels.
    #[default]
    Motion,
    /// What wheels and legs report: legs step as they are told, blocked or not, and neither feels a push.
    Motors,
}

/// How long things are believed that are not seen, and what is believed of a ball among robots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MemorySpans {
    /// s.
    pub ball: f32,
    /// s.
    pub robots: f32,
    /// How long a ball may be hidden behind robots before frames without it count as misses, s; for ever without it.
    #[serde(default)]
    pub hidden_ball: Option<f32>,
    /// The velocity of a ball is unknown while a robot is seen nearer to it than this, m.
    #[serde(default)]
    pub touched_ball: f32,
    /// Readings near each other until a ball is believed where none was, or until one that was believed elsewhere is believed there.
    #[serde(default)]
    pub jump_readings: u32,
}

impl Validate for Sensing {
    fn validate(&self) -> Result<(), Fault> {
        self.eyes.validate_as("eyes")?;
        check_all([
            ("memory.ball", self.memory.ball, Bound::SECONDS),
            ("memory.robots", self.memory.robots, Bound::SECONDS),
            ("memory.hidden_ball", self.memory.hidden_ball.unwrap_or(0.0), Bound::SECONDS),
            ("memory.touched_ball", self.memory.touched_ball, Bound::LENGTH),
        ])?;
        check_count(
            "memory.jump_readings",
            "the number of readings",
            self.memory.jump_readings as usize,
            0..=MOST_READINGS,
        )
    }
}

/// Readings of a ball.
const MOST_READINGS: usize = 1000;

impl Validate for Eyes {
    fn validate(&self) -> Result<(), Fault> {
        if let Eyes::Real { localisation, .. } = self {
            localisation.validate_as("localisation")?;
        }
        let (Some(camera), Some(odometry)) = (self.camera(), self.odometry()) else { return Ok(()) };
        camera.validate_as("camera")?;
        check_all([
            ("odometry.distance", odometry.distance, Bound::LENGTH),
            ("odometry.heading", odometry.heading, Bound::ANGLE),
            ("put_down.position", self.put_down().position, Bound::LENGTH),
            ("put_down.heading", self.put_down().heading, Bound::ANGLE),
        ])
    }
}

impl Validate for Camera {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("field_of_view", self.field_of_view, Bound::ANGLE.positive()),
            ("frame_hz", self.frame_hz, Bound::RATE.positive()),
            ("latency", self.latency, Bound::DELAY),
            ("ball_range", self.ball_range, Bound::LENGTH.positive()),
            ("robot_range", self.robot_range, Bound::LENGTH.positive()),
            ("range_noise", self.range_noise, Bound::COEFFICIENT),
            ("range_floor", self.range_floor, Bound::LENGTH),
            ("bearing_noise", self.bearing_noise, Bound::ANGLE),
            ("detection", self.detection, Bound::SHARE),
            ("visible_share", self.visible_share, Bound::SHARE),
            ("false_positive", self.false_positive, Bound::SHARE),
            ("wrong_team", self.wrong_team, Bound::SHARE),
        ])
    }
}

impl Validate for Localisation {
    fn validate(&self) -> Result<(), Fault> {
        self.landmarks.validate_as("landmarks")?;
        check_all([
            ("position", self.position, Bound::LENGTH),
            ("heading", self.heading, Bound::ANGLE),
            ("drift_time", self.drift_time, Bound::SECONDS.positive()),
            ("jump_time", self.jump_time, Bound::SECONDS.positive()),
            ("put_down.position", self.put_down.position, Bound::LENGTH),
            ("put_down.heading", self.put_down.heading, Bound::ANGLE),
        ])
    }
}

impl Validate for Landmarks {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("posts", self.posts, Bound::LENGTH),
            ("beacons", self.beacons, Bound::LENGTH),
            ("lines", self.lines, Bound::LENGTH),
            ("one", self.one, Bound::SHARE),
            ("line", self.line, Bound::SHARE),
            ("looks_down", self.looks_down, Bound::LENGTH),
            ("settle", self.settle, Bound::SECONDS.positive()),
        ])
    }
}
