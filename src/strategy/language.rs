//! The words of a strategy file: points, sets of points, features, motor schemas. All positions are metres in the team frame
//! (x towards the opponents' goal, y to the left), times seconds, angles degrees.
//!
//! A file may name a piece in `percepts`, `point_sets`, `features` or `schemas` and use it by that name; once a strategy is
//! loaded, every name has been replaced by what it stands for.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::mechanism::Mechanism;
use crate::geometry::Zone;
use crate::protocol::arbitration::PlayerAction;
use crate::strategy::role::RoleRef;

/// One place on the field, or nowhere while it is unknown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Point {
    /// A point from `percepts`.
    Named(String),
    /// Where the robot believes the ball is.
    Ball,
    /// Where the ball is by the robot's own eyes, or by the freshest report of a team mate.
    TeamBall,
    /// Where the ball will be in this many seconds, as it rolls.
    BallIn(f32),
    /// The middle of the team's own goal line.
    OurGoal,
    /// The middle of the opponents' goal line.
    TheirGoal,
    /// The homebase that the robot's role has chosen.
    Homebase,
    /// Where the robot believes it is itself.
    Own,
    /// The team mate that has claimed the ball.
    Carrier,
    /// The team mate that has booked the ball.
    Booker,
    /// The team mate in a role, as far as it is known who that is.
    Teammate(RoleRef),
    /// `behind` metres behind the carrier and `aside` metres off its way to their goal, on the side where the robot is.
    SupportSpot { behind: f32, aside: f32 },
    /// A point on the half of the field that the goalie did not last leave or enter its area by; `y` is how far from the middle.
    AwayFromGoalie { x: f32, y: f32 },
    /// The robot's place among those of the team mates that leave the ball to another (TeamChaos, section 4, requirement 4):
    /// a task for each that is left, by importance.
    OptimalPosition(Vec<CoverTask>),
    /// This place.
    At(Vec2),
    /// The member of a set that is nearest to the robot.
    Closest(Box<Points>),
    /// The mean of a set.
    Average(Box<Points>),
    /// Halfway between two points.
    Midpoint(Box<Point>, Box<Point>),
    /// A point moved by the way from one point to another.
    Moved { of: Box<Point>, from: Box<Point>, to: Box<Point> },
    /// `distance` metres from one point on the way to another; negative distances lead away from it.
    Toward { from: Box<Point>, to: Box<Point>, distance: f32 },
    /// `offset` metres behind a point, as seen from another: where to stand to push it there.
    SweetSpot { of: Box<Point>, toward: Box<Point>, offset: f32 },
    /// Where a robot of this speed (m/s) meets the rolling ball.
    Intercept { max_speed: f32 },
    /// The place in a zone that is nearest to a point.
    Into { zone: ZoneName, point: Box<Point> },
}

/// What a robot does for its team that leaves the ball to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CoverTask {
    /// It stands between the ball and the own goal.
    ScreenGoal,
    /// It waits before their goal, beside the way of a shot.
    ReceiveRebound,
    /// It goes where nobody is.
    CoverSpace,
}

/// Any number of places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Points {
    /// A set from `point_sets`.
    Named(String),
    /// All team mates that the robot knows of.
    Teammates,
    /// All opponents that the robot knows of.
    Opponents,
    /// The team mates that rank above the robot.
    Superiors,
    /// The team mates that rank neither above nor below the robot: all of them where there is no hierarchy.
    Peers,
    /// The team mate that has claimed the ball, if there is one.
    Claimant,
    /// The nearest point of each of the four walls.
    Walls,
    /// Exactly these.
    These(Vec<Point>),
    /// The members of all these sets.
    Union(Vec<Points>),
    /// Those within `radius` of the robot.
    Within { of: Box<Points>, radius: f32 },
    /// Those within `radius` of the robot; the nearest one, where there are none.
    WithinOrClosest { of: Box<Points>, radius: f32 },
    /// Those farther than `radius` from a point.
    FartherThan { of: Box<Points>, from: Box<Point>, radius: f32 },
    /// Also those of the last `seconds`; a new one within `merge` metres replaces an old one, of which the share
    /// `blend` is kept.
    Remember {
        of: Box<Points>,
        seconds: f32,
        merge: f32,
        blend: f32,
        #[serde(skip)]
        slot: usize,
    },
    /// All of them, moved by a vector.
    Shifted { of: Box<Points>, by: Vec2 },
}

/// A zone that every robot knows, or one of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ZoneName {
    /// A zone from `zones`.
    Named(String),
    /// The zone of control of the robot's role (figure 2).
    DangerZone,
    /// The zone of control of another role.
    DangerZoneOf(RoleRef),
    /// The area in front of the team's own goal.
    PenaltyArea,
    /// This rectangle.
    Exactly(Zone),
}

/// A statement that is true or false.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Feature {
    /// A statement from `features`.
    Is(String),
    /// True.
    Always,
    /// It is false.
    Not(Box<Feature>),
    /// All of them are true.
    All(Vec<Feature>),
    /// One of them is true at least.
    Any(Vec<Feature>),
    /// The place of something is known.
    Known(Point),
    /// The camera has shown the ball within this many seconds.
    BallSeenWithin(f32),
    /// Two points are known and nearer than `radius`.
    Near { a: Point, b: Point, radius: f32 },
    /// As `Near`, but once true it stays true up to the radius `leave`.
    NearLatch {
        a: Point,
        b: Point,
        enter: f32,
        leave: f32,
        #[serde(skip)]
        slot: usize,
    },
    /// `a` is nearer to the robot than `b`.
    NearerThan { a: Point, b: Point },
    /// A point is known and lies in a zone.
    In { zone: ZoneName, point: Point },
    /// A point is known and within this many degrees of straight ahead.
    Facing { point: Point, within: f32 },
    /// Robot, ball and target are in line within this many degrees, with the robot behind.
    BehindBall { toward: Point, within: f32 },
    /// The ball lies in front of the robot's body: `gap` metres between them at most, `aside` metres off the middle at most.
    BallInScoop { gap: f32, aside: f32 },
    /// A mechanism of teamwork is on.
    On(Mechanism),
    /// The robot has this role itself, whatever sub-role it acts in.
    InRole(RoleRef),
    /// The robot's own claim of the ball holds.
    HasBall,
    /// A team mate's claim of the ball holds, one in one of these roles; any, if none is named.
    TeammateHasBall(Vec<RoleRef>),
    /// A team mate's claim of the ball holds that ranks above the robot.
    SuperiorHasBall,
    /// The robot has booked the ball.
    HasBooked,
    /// A team mate has booked the ball, and has renewed the booking recently.
    TeammateHasBooked,
    /// Of all robots of the team it is this one that may execute the action now.
    MayExecute(PlayerAction),
    /// The ball is held under the robot's own chin.
    HoldsBall,
    /// The goalie has said that it left its area, and not that it is back.
    GoalieIsOut,
    /// The robot's drive reports that it is blocked; never without bump sensing.
    Bumped,
    /// Less than this share of the messages that the league allows the team is left; never where nobody counts them.
    MessagesLeftBelow(f32),
    /// The robot has been told to move for this many seconds and finds by its wheels and its landmarks that it has not moved.
    Stalled(f32),
    /// The robot has been in its present state for this many seconds.
    After(f32),
    /// The statement was true within the last `seconds`.
    HoldFor {
        what: Box<Feature>,
        seconds: f32,
        #[serde(skip)]
        slot: usize,
    },
    /// The statement has been true for `seconds` without a break.
    Lasting {
        what: Box<Feature>,
        seconds: f32,
        #[serde(skip)]
        slot: usize,
    },
    /// The statement was not true for `patience` seconds; stays true for `seconds`.
    Watchdog {
        what: Box<Feature>,
        patience: f32,
        seconds: f32,
        #[serde(skip)]
        slot: usize,
    },
}

/// A motor schema: what it turns into a direction and a speed between 0 and 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Schema {
    /// Linear attraction: full speed beyond `controlled_zone`, none within `dead_zone`.
    GoTo {
        target: Point,
        #[serde(default)]
        controlled_zone: f32,
        #[serde(default)]
        dead_zone: f32,
    },
    /// Linear attraction to each point of a set.
    GoToAll {
        targets: Points,
        #[serde(default)]
        controlled_zone: f32,
        #[serde(default)]
        dead_zone: f32,
    },
    /// Attraction that grows as the robot comes nearer.
    AttractNear { to: Points, sphere: f32, safety: f32 },
    /// Linear repulsion within `sphere`, strongest within `safety`.
    Avoid { of: Points, sphere: f32, safety: f32 },
    /// Leads around what lies on the way to `toward`.
    Swirl { around: Points, toward: Point, sphere: f32, safety: f32 },
    /// Leads around everything, always on its left.
    SwirlLeft { around: Points, sphere: f32, safety: f32 },
    /// Leads around what is ahead, strongest a little off the middle.
    GeoField { around: Points, toward: Point, sphere: f32, safety: f32 },
    /// A random direction, drawn every `period` seconds.
    Noise {
        period: f32,
        #[serde(skip)]
        slot: usize,
    },
    /// Gets behind the ball, facing `toward`; where a wall leaves no room there, comes to it from elsewhere and sweeps it out.
    DockBehind {
        #[serde(default = "ball")]
        ball: Point,
        toward: Point,
        standoff: f32,
        #[serde(default = "enter_cone")]
        enter_cone: f32,
        #[serde(default = "leave_cone")]
        leave_cone: f32,
        #[serde(skip)]
        slot: usize,
    },
    /// Pushes a ball that is in the scoop towards a point, turning no more than `tight` degrees at a time.
    Dribble {
        #[serde(default = "ball")]
        ball: Point,
        toward: Point,
        tight: f32,
    },
    /// Always the same vector.
    Constant(Vec2),
}

/// What a schema does to a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SchemaKind {
    /// It draws the robot to a place.
    Attraction,
    /// It keeps the robot away from things.
    Repulsion,
    /// It leads the robot around things.
    Detour,
    /// It works at the ball.
    Handling,
    /// It heeds nothing around the robot.
    Unguided,
    /// It is an assemblage within another and does several of these.
    Blended,
}

impl Schema {
    /// What it does to a robot.
    pub fn kind(&self) -> SchemaKind {
        match self {
            Schema::GoTo { .. } | Schema::GoToAll { .. } | Schema::AttractNear { .. } => {
                SchemaKind::Attraction
            }
            Schema::Avoid { .. } => SchemaKind::Repulsion,
            Schema::Swirl { .. } | Schema::SwirlLeft { .. } | Schema::GeoField { .. } => SchemaKind::Detour,
            Schema::DockBehind { .. } | Schema::Dribble { .. } => SchemaKind::Handling,
            Schema::Noise { .. } | Schema::Constant(_) => SchemaKind::Unguided,
        }
    }
}

impl SchemaKind {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            SchemaKind::Attraction => "draws the robot to a place",
            SchemaKind::Repulsion => "keeps the robot away from things",
            SchemaKind::Detour => "leads the robot around things",
            SchemaKind::Handling => "works at the ball",
            SchemaKind::Unguided => "heeds nothing around the robot",
            SchemaKind::Blended => "an assemblage, as far as it is desirable now",
        }
    }
}

fn ball() -> Point {
    Point::Ball
}

fn enter_cone() -> f32 {
    60.0
}

fn leave_cone() -> f32 {
    75.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attraction_and_repulsion_are_told_from_the_rest() {
        let go = Schema::GoTo { target: Point::Ball, controlled_zone: 0.0, dead_zone: 0.0 };
        let avoid = Schema::Avoid { of: Points::Walls, sphere: 1.0, safety: 0.5 };
        let swirl = Schema::SwirlLeft { around: Points::Opponents, sphere: 1.0, safety: 0.5 };
        let dribble = Schema::Dribble { ball: Point::Ball, toward: Point::TheirGoal, tight: 25.0 };
        let kinds = [&go, &avoid, &swirl, &dribble, &Schema::Constant(Vec2::X)].map(Schema::kind);
        use SchemaKind::{Attraction, Detour, Handling, Repulsion, Unguided};
        assert_eq!(kinds, [Attraction, Repulsion, Detour, Handling, Unguided]);
    }
}
