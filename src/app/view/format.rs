//! Figures, clocks and robots as people read them: units beside them, two decimals at most, a real minus sign.
//!
//! The digits and the minus sign of the window's font are equally wide, so figures that are aligned to the right stand still.

use bevy::prelude::*;

use crate::geometry::wrap_angle;
use crate::ids::RobotId;

/// Stands where a figure is unknown.
pub const UNKNOWN: &str = "–";

/// A number with this many decimals and a minus sign as wide as a digit; what rounds to zero has no sign.
pub fn fixed(value: f32, decimals: usize) -> String {
    if !value.is_finite() {
        return UNKNOWN.into();
    }
    let digits = format!("{:.decimals$}", value.abs());
    let zero = digits.bytes().all(|byte| matches!(byte, b'0' | b'.'));
    if value < 0.0 && !zero { format!("−{digits}") } else { digits }
}

/// Metres, to the centimetre.
pub fn metres(value: f32) -> String {
    format!("{} m", fixed(value, 2))
}

/// A speed to the centimetre a second.
pub fn speed(value: f32) -> String {
    format!("{} m/s", fixed(value, 2))
}

/// An angle in radians as whole degrees without the sign, from −180 to 180.
pub fn degrees(radians: f32) -> String {
    fixed(wrap_angle(radians).to_degrees(), 0)
}

/// An angle from straight ahead in words, such as `23° left`.
pub fn aside(radians: f32) -> String {
    let whole = wrap_angle(radians).to_degrees().round();
    match whole {
        0.0 => "straight ahead".into(),
        180.0 | -180.0 => "straight behind".into(),
        _ => format!("{:.0}° {}", whole.abs(), if whole > 0.0 { "left" } else { "right" }),
    }
}

/// A span of time: tenths below ten seconds, minutes from one minute on.
pub fn seconds(value: f32) -> String {
    // Compared as they will be rounded, so that 59.97 does not become 60 s.
    let whole = value.round();
    if !value.is_finite() {
        UNKNOWN.into()
    } else if whole >= 60.0 {
        format!("{}:{:02} min", whole as u64 / 60, whole as u64 % 60)
    } else if value >= 9.95 {
        format!("{whole:.0} s")
    } else {
        format!("{} s", fixed(value, 1))
    }
}

/// The seconds between two ticks; none if the later one is earlier.
pub fn span(from: u64, to: u64, dt: f32) -> f32 {
    to.saturating_sub(from) as f32 * dt
}

/// A tick as seconds of the match.
pub fn moment(tick: u64, dt: f32) -> String {
    format!("{:.2} s", tick as f64 * f64::from(dt))
}

/// A share of one as whole per cent.
pub fn percent(share: f32) -> String {
    format!("{} %", fixed(100.0 * share, 0))
}

/// How many of a thing: `1 robot`, `2 robots`.
pub fn count(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}

/// A vector as its two coordinates.
pub fn coordinates(v: Vec2) -> [String; 2] {
    [fixed(v.x, 2), fixed(v.y, 2)]
}

/// Minutes and seconds of a time in seconds, rounded up, so that 0:00 means over. A clock that has run over is negative.
pub fn clock(seconds: f64) -> String {
    let whole = seconds.ceil();
    let sign = if whole < 0.0 { "−" } else { "" };
    let whole = whole.abs() as u64;
    format!("{sign}{:02}:{:02}", whole / 60, whole % 60)
}

/// A speed as people write it.
pub fn times(factor: f32) -> String {
    if factor < 1.0 { format!("1/{}×", (1.0 / factor).round()) } else { format!("{factor}×") }
}

/// A robot at the beginning of a sentence.
pub fn capitalised(robot: RobotId) -> String {
    let text = robot.to_string();
    text[..1].to_uppercase() + &text[1..]
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;
    use crate::app::view::state::Playback;
    use crate::ids::Team;

    #[test]
    fn negative_figures_have_a_real_minus_and_zero_has_none() {
        assert_eq!(fixed(-1.236, 2), "−1.24");
        assert_eq!(fixed(-0.004, 2), "0.00");
        assert_eq!(fixed(-0.4, 0), "0");
        assert_eq!(metres(3.0), "3.00 m");
    }

    #[test]
    fn what_is_no_number_is_unknown() {
        assert_eq!(fixed(f32::NAN, 2), UNKNOWN);
        assert_eq!(seconds(f32::INFINITY), UNKNOWN);
    }

    #[test]
    fn angles_say_which_side() {
        assert_eq!(aside(0.4), "23° left");
        assert_eq!(aside(-0.4), "23° right");
        assert_eq!(aside(0.001), "straight ahead");
        assert_eq!(aside(PI), "straight behind");
        assert_eq!(aside(1.5 * PI), "90° right");
        assert_eq!(degrees(-PI / 2.0), "−90");
    }

    #[test]
    fn spans_become_coarser_as_they_grow() {
        assert_eq!(seconds(0.25), "0.2 s");
        assert_eq!(seconds(9.96), "10 s");
        assert_eq!(seconds(59.97), "1:00 min");
        assert_eq!(seconds(125.2), "2:05 min");
        assert_eq!(span(7, 3, 0.1), 0.0);
    }

    #[test]
    fn one_is_not_plural() {
        assert_eq!(count(1, "robot"), "1 robot");
        assert_eq!(count(0, "robot"), "0 robots");
    }

    #[test]
    fn the_clock_counts_down_and_is_negative_when_it_has_run_over() {
        assert_eq!(clock(600.0), "10:00");
        assert_eq!(clock(59.2), "01:00");
        assert_eq!(clock(59.0), "00:59");
        assert_eq!(clock(0.001), "00:01");
        assert_eq!(clock(0.0), "00:00");
        assert_eq!(clock(-0.5), "00:00");
        assert_eq!(clock(-61.0), "−01:01");
    }

    #[test]
    fn speeds_read_as_people_write_them() {
        let all: Vec<String> = Playback::SPEEDS.into_iter().map(times).collect();
        assert_eq!(all, ["1/8×", "1/4×", "1/2×", "1×", "2×", "4×", "8×", "16×", "32×", "64×"]);
    }

    #[test]
    fn a_sentence_begins_with_a_capital() {
        assert_eq!(capitalised(RobotId::new(Team::Home, 3)), "Home 3");
    }
}
