//! What is exported of a match says what happened in it.

use std::collections::BTreeMap;
use std::io::Read;
use std::sync::LazyLock;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;
use touchline::game::{Choice, Match, MatchPlan};
use touchline::geometry::{Pose, Vec2, wrap_angle};
use touchline::ids::RobotId;
use touchline::lab::export::{ExportError, ExportWishes, Exported, PageForks, PageWish, export};
use touchline::robot::Trailer;
use touchline::world::ball::Ball;

use crate::support::{assets, digest_of};

const STRETCH: (u64, u64) = (600, 660);

/// Half a minute a half, with role swaps over a radio that loses messages.
fn played() -> MatchPlan {
    let choice = Choice {
        seed: 4,
        half_minutes: Some(0.5),
        home: Some("rmit".into()),
        radio: Some("bursty".into()),
        ..Choice::default()
    };
    MatchPlan::read(&assets(), &choice).expect("the shipped match is sound")
}

static EXPORTED: LazyLock<Exported> = LazyLock::new(|| {
    let wishes = ExportWishes {
        page: Some(PageWish { forks: PageForks::BeforeGoals(2) }),
        log: true,
        picture: Some(900),
        film: Some(STRETCH),
    };
    export(&played(), None, wishes, &mut |_| true).expect("a match is exported")
});

/// What the script of the page reads.
fn page_data() -> Value {
    let page = EXPORTED.page.as_deref().expect("a page is wanted");
    let (_, rest) = page.split_once("type=\"application/octet-stream\">").expect("the page has data");
    let (data, _) = rest.split_once("</script>").expect("the data ends");
    let packed = BASE64_STANDARD.decode(data).expect("it is base64");
    let mut text = String::new();
    flate2::read::GzDecoder::new(&packed[..]).read_to_string(&mut text).expect("it is compressed");
    serde_json::from_str(&text).expect("it is JSON")
}

/// A column of differences as what they are the differences of.
fn summed(column: &Value) -> Vec<i64> {
    let steps = column.as_array().expect("a column").iter().map(|step| step.as_i64().expect("a number"));
    steps
        .scan(0, |sum, step| {
            Some({
                *sum += step;
                *sum
            })
        })
        .collect()
}

/// The values of a track at all ticks, by the straight lines between its knots.
fn along(table: &Value, units: &[f64]) -> Vec<Vec<f64>> {
    assert!(table.get("runs").is_none(), "a body is always somewhere");
    let times = summed(&table["t"]);
    let columns: Vec<Vec<i64>> = table["v"].as_array().expect("columns").iter().map(summed).collect();
    let value = |knot: usize| -> Vec<f64> {
        columns.iter().zip(units).map(|(column, unit)| column[knot] as f64 * unit).collect()
    };
    let mut all = vec![value(0)];
    for knot in 1..times.len() {
        let (from, to, ticks) = (value(knot - 1), value(knot), times[knot] - times[knot - 1]);
        for tick in 1..=ticks {
            let share = tick as f64 / ticks as f64;
            all.push(from.iter().zip(&to).map(|(from, to)| from + share * (to - from)).collect());
        }
    }
    all
}

#[test]
fn the_page_has_every_body_at_every_tick_where_it_was() {
    let page = page_data();
    let exact = |of: &str, part: usize| page["exact"][of][part].as_f64().expect("a number");
    let (place, place_off) = (exact("place", 0), exact("place", 1));
    let (heading, heading_off) = (exact("heading", 0), exact("heading", 1));
    assert!(place_off <= 0.005 && heading_off <= 1.0_f64.to_radians() + 1e-9);
    let ball = along(&page["ball"]["track"], &[place, place]);
    let robots = page["robots"].as_array().expect("robots");
    let tracks: BTreeMap<String, [Vec<Vec<f64>>; 2]> = (robots.iter())
        .map(|robot| {
            let name = robot["name"].as_str().expect("a name").to_owned();
            let unit = along(&robot["track"], &[place, place, heading]);
            (name, [unit, along(&robot["trailer"], &[heading])])
        })
        .collect();
    let plan = played();
    let mut game = Match::new(&plan);
    let mut bodies = game.world_mut().query::<(&Pose, Option<&RobotId>, Option<&Trailer>, Option<&Ball>)>();
    let near = |shown: f64, truth: f32, off: f64, angle: bool| {
        let way = shown - f64::from(truth);
        let way = if angle { f64::from(wrap_angle(way as f32)) } else { way };
        assert!(way.abs() <= off + 1e-5, "off by {way}, may be {off}");
    };
    for tick in 0.. {
        for (pose, robot, trailer, is_ball) in bodies.iter(game.world()) {
            let Vec2 { x, y } = pose.position;
            let shown = match (robot, trailer, is_ball) {
                (Some(robot), ..) => &tracks[&robot.to_string()][0][tick],
                (_, Some(trailer), _) => {
                    near(tracks[&trailer.of.to_string()][1][tick][0], pose.heading, heading_off, true);
                    continue;
                }
                (_, _, Some(_)) => &ball[tick],
                _ => continue,
            };
            near(shown[0], x, place_off, false);
            near(shown[1], y, place_off, false);
            if robot.is_some() {
                near(shown[2], pose.heading, heading_off, true);
            }
        }
        if game.is_over() {
            assert_eq!(ball.len(), tick + 1);
            break;
        }
        game.tick();
    }
}

#[test]
fn a_match_that_is_exported_is_the_same_match() {
    assert_eq!(EXPORTED.counts.digest, format!("{:016x}", digest_of(&played())));
    assert_eq!(page_data()["digest"].as_str(), Some(EXPORTED.counts.digest.as_str()));
}

#[test]
fn the_page_tells_messages_that_were_lost_and_attempts_to_swap_roles() {
    let page = page_data();
    let words: Vec<&str> =
        page["words"].as_array().expect("words").iter().map(|word| word.as_str().expect("a word")).collect();
    let messages = &page["messages"];
    let column = |name: &str| messages[name].as_array().expect("a column").clone();
    let kinds: Vec<&str> =
        column("kind").iter().map(|kind| words[kind.as_u64().expect("a number") as usize]).collect();
    assert!(!kinds.contains(&"position"));
    let lost = column("lost").iter().filter(|lost| lost.as_u64() > Some(0)).count();
    assert!(lost > 0 && lost < kinds.len(), "{lost} of {} are lost", kinds.len());
    for (kind, attempt) in kinds.iter().zip(column("attempt")) {
        let is_of_a_swap = ["LOCK", "ACKLOCK", "SWAP", "ACKSWAP"].contains(kind);
        assert_eq!(is_of_a_swap, attempt.as_u64() > Some(0), "{kind}");
    }
    assert!(kinds.contains(&"LOCK"), "{kinds:?}");
}

#[test]
fn the_log_reads_back_with_as_many_messages_as_are_told() {
    let log = EXPORTED.log.as_deref().expect("a log is wanted");
    let mut counts: BTreeMap<String, u64> = EXPORTED
        .counts
        .log
        .as_ref()
        .expect("they are counted")
        .keys()
        .map(|topic| (topic.clone(), 0))
        .collect();
    let mut last = 0;
    for message in mcap::MessageStream::new(log).expect("it is a log") {
        let message = message.expect("each message is sound");
        let _: Value = serde_json::from_slice(&message.data).expect("each message is JSON");
        assert!(message.log_time >= last, "time goes on");
        last = message.log_time;
        *counts.get_mut(&message.channel.topic).expect("each topic is told") += 1;
    }
    assert_eq!(Some(&counts), EXPORTED.counts.log.as_ref());
    assert!(counts.iter().all(|(topic, count)| *count > 0 || topic == "/bookings"), "{counts:?}");
}

#[test]
fn the_picture_shows_all_robots_and_is_sound_xml() {
    let picture = EXPORTED.picture.as_deref().expect("a picture is wanted");
    let mut reader = quick_xml::Reader::from_str(picture);
    let mut elements: BTreeMap<String, usize> = BTreeMap::new();
    loop {
        match reader.read_event().expect("it is XML") {
            quick_xml::events::Event::Eof => break,
            quick_xml::events::Event::Start(element) | quick_xml::events::Event::Empty(element) => {
                let name = String::from_utf8_lossy(element.name().as_ref()).into_owned();
                *elements.entry(name).or_default() += 1;
            }
            _ => {}
        }
    }
    // Eight numbers on plates, and the score with its colon.
    assert_eq!(elements["text"], 8 + 3, "{elements:?}");
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
}

#[test]
fn the_film_has_a_frame_every_three_ticks() {
    let film = EXPORTED.film.as_deref().expect("a film is wanted");
    let mut reader = gif::DecodeOptions::new().read_info(film).expect("it is a GIF");
    let mut frames = 0;
    while reader.read_next_frame().expect("each frame is sound").is_some() {
        frames += 1;
    }
    assert_eq!((frames, EXPORTED.counts.frames), (21, Some(21)));
}

#[test]
fn a_moment_after_the_end_is_refused() {
    let mut plan = played();
    plan.rules.half_minutes = 0.05;
    let wishes = ExportWishes { picture: Some(1_000_000), ..ExportWishes::default() };
    let refused = export(&plan, None, wishes, &mut |_| true).expect_err("there is no such moment");
    assert!(matches!(refused, ExportError::TooLate { wanted: 1_000_000, .. }), "{refused}");
    let stopped = export(&plan, None, ExportWishes::default(), &mut |_| false).expect_err("it is to stop");
    assert!(matches!(stopped, ExportError::Interrupted));
}
