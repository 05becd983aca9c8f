//! How the hall is painted: which colour is where and how high it reaches. What draws pictures paints by these facts, and what
//! recognises things in pictures expects them. Sizes on the carpet are the [pitch's](Pitch).

use super::colours::ColourClass;
use crate::pitch::Pitch;

/// Red, green and blue of a paint in the hall's own light, as a camera that suits that light shows it.
pub type Rgb = [u8; 3];

/// Bodies of AIBOs.
pub const LIGHT_GREY: Rgb = [150, 152, 156];
/// Drive units, trailers and shafts of Cyes.
pub const DARK_GREY: Rgb = [52, 52, 56];
/// A fence behind a margin of carpet, and goals from outside.
pub const FENCE_GREY: Rgb = [82, 82, 84];
/// What is behind walls and fences.
pub const HALL_GREY: Rgb = [112, 110, 106];

/// What people around a pitch wear and are: dark cloth, jeans, skin, and shirts in colours that are like those of a pitch.
pub const CLOTHES: [Rgb; 8] = [
    [38, 38, 42],
    [58, 72, 104],
    [196, 150, 122],
    [188, 44, 48],
    [214, 124, 52],
    [214, 196, 84],
    [92, 148, 196],
    [200, 104, 148],
];

/// Of a fence, m.
pub const FENCE_HEIGHT: f32 = 0.3;
/// Of a beacon, m.
pub const BEACON_RADIUS: f32 = 0.05;
/// Of a beacon, m.
pub const BEACON_HEIGHT: f32 = 0.4;
/// The two coloured bands of a beacon, the lower one first; it is white below.
pub const BEACON_BANDS: [HeightBand; 2] =
    [HeightBand { bottom: 0.2, top: 0.3 }, HeightBand { bottom: 0.3, top: BEACON_HEIGHT }];

/// The nominal colour of a class.
pub const fn paint(class: ColourClass) -> Rgb {
    match class {
        ColourClass::Orange => [225, 95, 25],
        ColourClass::Yellow => [235, 205, 30],
        ColourClass::SkyBlue => [60, 150, 215],
        ColourClass::Pink => [225, 80, 140],
        ColourClass::Red => [175, 25, 35],
        ColourClass::DarkBlue => [25, 35, 110],
        ColourClass::White => [235, 235, 235],
        ColourClass::Green => [30, 110, 50],
    }
}

/// The colour of the goal that stands in the east, or in the west.
pub const fn goal_colour(east: bool) -> ColourClass {
    if east { ColourClass::SkyBlue } else { ColourClass::Yellow }
}

/// The colours of a beacon, the lower one first: pink, and the colour of the goal at its end. Pink is on top in the north (y > 0)
/// and below in the south.
pub const fn beacon_colours(east: bool, north: bool) -> [ColourClass; 2] {
    if north { [goal_colour(east), ColourClass::Pink] } else { [ColourClass::Pink, goal_colour(east)] }
}

/// From how high to how high something reaches, m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each field is named after its height")]
pub struct HeightBand {
    pub bottom: f32,
    pub top: f32,
}

impl HeightBand {
    /// m.
    pub fn height(self) -> f32 {
        self.top - self.bottom
    }
}

/// How a kind of robot is painted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotPaint {
    /// Of the body.
    pub body: Rgb,
    /// Of the body, m.
    pub height: f32,
    /// The marker in the team's colour.
    pub marker: HeightBand,
    /// Of a round marker on a shaft over the robot's centre, m. Without it the marker goes around the body.
    pub marker_radius: Option<f32>,
}

impl RobotPaint {
    /// A walker wears its marker like a shirt. Its height includes the head. ASSUMPTION: all heights.
    pub const WALKER: RobotPaint = RobotPaint {
        body: LIGHT_GREY,
        height: 0.28,
        marker: HeightBand { bottom: 0.10, top: 0.18 },
        marker_radius: None,
    };

    /// A robot on wheels carries camera and marker on a shaft. ASSUMPTION: all heights.
    pub const WHEELED: RobotPaint = RobotPaint {
        body: DARK_GREY,
        height: 0.25,
        marker: HeightBand { bottom: 0.45, top: 0.60 },
        marker_radius: Some(0.08),
    };
}

/// How a pitch is painted, where leagues differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchPaint {
    /// Of the coloured insides of goals, m.
    pub goal_height: f32,
    /// Of a painted line, m.
    pub line_width: f32,
    /// Of white walls that stand where the lines would be, m; nothing, if lines are painted and a fence stands behind them.
    pub walls: Option<f32>,
}

impl PitchPaint {
    /// Of a pitch: the four-legged league paints lines, the middle-size league of 2001 has walls. ASSUMPTION: all heights.
    pub fn of(pitch: &Pitch) -> PitchPaint {
        if pitch.margin() > 0.0 {
            PitchPaint { goal_height: 0.3, line_width: 0.025, walls: None }
        } else {
            PitchPaint { goal_height: 0.9, line_width: 0.05, walls: Some(0.3) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_beacons_look_alike() {
        let ends = [(true, true), (true, false), (false, true), (false, false)];
        let all: std::collections::BTreeSet<_> =
            ends.into_iter().map(|(east, north)| beacon_colours(east, north)).collect();
        assert_eq!(all.len(), 4);
    }

    #[test]
    fn only_a_pitch_without_margin_has_walls() {
        let mut pitch = crate::testing::pitch();
        assert!(PitchPaint::of(&pitch).walls.is_some());
        pitch.walls.margin = 1.0;
        assert!(PitchPaint::of(&pitch).walls.is_none());
    }
}
