//! The page with what a referee box says of the match beside how the match stands, and what each robot was told.

use bevy::prelude::*;
use bevy_egui::egui::{self, RichText};

use crate::app::inspector::table::{Column, counts, heading, row, words};
use crate::app::view::picture::labels::off_text;
use crate::app::view::{colours, format};
use crate::clock::Clock;
use crate::ids::{RobotId, Team};
use crate::robot::Orders;
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::control::SetPlay;
use crate::world::gamecontroller::referee_box::{BoxView, PacketCounts};
use crate::world::gamecontroller::serving::Serving;
use crate::world::referee::MatchState;

const MATCH: [Column; 3] = [
    words("", 96.0, ""),
    words("the box says", 170.0, "The RoboCup GameController, in its last packet that was news"),
    words("the match is", 150.0, "The match as it stands here"),
];
const PACKETS: [Column; 2] =
    [words("packets", 130.0, "What became of the packets heard"), counts("", 56.0, "")];
const ORDERS: [Column; 3] = [
    words("robot", 70.0, "A robot of the team"),
    words("is told", 84.0, "In which of the league's six states it has been told to be"),
    words("", 130.0, "How long it is off yet, and where it should stand at the kick-off"),
];

/// The counts of packets that were heard.
const FATES: [(&str, &str); 8] = [
    ("news", "Packets that were followed"),
    ("repeated", "The newest packet once more"),
    ("of something else", "They are no control packets"),
    ("other version", "Control packets of a version that is not understood"),
    ("wrong length", "Control packets that are too short or too long"),
    ("other teams", "Control packets about a match that is not played here"),
    ("other box", "Control packets of another box, while the one that is followed lives"),
    ("overtaken", "Control packets that a later one had overtaken"),
];

/// In the order of [`FATES`].
fn fates(heard: &PacketCounts) -> [u64; 8] {
    let PacketCounts { news, repeated, not_ours, version, length, teams, sender, stale } = *heard;
    [news, repeated, not_ours, version, length, teams, sender, stale]
}

pub fn show(
    ui: &mut egui::Ui,
    news: Option<&BoxNews>,
    state: &MatchState,
    clock: &Clock,
    orders: &[(RobotId, Orders)],
) {
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| show_match(ui, news, state, clock));
            ui.separator();
            if let Some(news) = news {
                ui.vertical(|ui| {
                    heading(ui, &PACKETS);
                    for ((name, tip), count) in FATES.into_iter().zip(fates(&news.heard())) {
                        row(ui, &PACKETS, [name.into(), count.to_string()]).on_hover_text(tip);
                    }
                });
                ui.separator();
            }
            for team in Team::BOTH {
                ui.vertical(|ui| {
                    heading(ui, &ORDERS);
                    for (robot, orders) in orders.iter().filter(|(robot, _)| robot.team == team) {
                        show_order(ui, *robot, orders, state);
                    }
                });
            }
        });
    });
}

fn show_match(ui: &mut egui::Ui, news: Option<&BoxNews>, state: &MatchState, clock: &Clock) {
    match news {
        None => {
            ui.weak("No referee box: Touchline's own referee decides.");
        }
        Some(news) if news.view.is_none() => {
            ui.weak("A referee box is listened for, but has said nothing yet.");
        }
        Some(news) => {
            let ago = format::seconds(format::span(news.last, clock.tick, clock.dt));
            let who = match (news.sender(), news.team_numbers()) {
                (Some((at, version)), Some([home, away])) => {
                    let version = version as u8;
                    format!(" at {at} (version {version}, home is team {home}, away team {away})")
                }
                _ => String::new(),
            };
            if news.is_lost(clock) {
                let text =
                    format!("The referee box{who} is silent since {ago}: all stand until one is heard.");
                ui.colored_label(colours::egui(colours::CALL), text);
            } else {
                ui.weak(format!("The referee box{who} decides; it was heard {ago} ago."));
            }
        }
    }
    heading(ui, &MATCH);
    let view = news.and_then(|news| news.view.as_ref());
    for (name, said, stands) in rows(view, state) {
        row(ui, &MATCH, [name.into(), said.unwrap_or_else(|| format::UNKNOWN.into()), stands]);
    }
    for (team, penalties) in
        Team::BOTH.into_iter().zip(view.map(|view| &view.penalties).into_iter().flatten())
    {
        for penalised in penalties {
            let served = penalised.penalty.serving().map_or("", Serving::words);
            let (player, reason) = (penalised.player, penalised.penalty);
            let text = format!("{team} {player}: {reason}, {} s left, {served}", penalised.seconds_left);
            ui.label(RichText::new(text).color(colours::egui(colours::team_text(team))));
        }
    }
}

/// What the box says beside what is: name, the one if anything was said, and the other.
fn rows(view: Option<&BoxView>, state: &MatchState) -> [(&'static str, Option<String>, String); 8] {
    let score = |[home, away]: [u32; 2]| format!("{home} : {away}");
    let half = |first: bool| if first { "first" } else { "second" }.to_owned();
    let team = |side: usize| Team::BOTH.get(side).map_or(format::UNKNOWN.into(), Team::to_string);
    let kicks_off = Team::BOTH.into_iter().find(|team| state.kicks_off(*team));
    let kicks_off = kicks_off.map_or("nobody".into(), |team| team.to_string());
    let said = |words: &dyn Fn(&BoxView) -> String| view.map(words);
    let stops = |stopped: bool| if stopped { "stopped" } else { "goes on" }.to_owned();
    let play = |view: &BoxView| match view.set_play {
        SetPlay::None => "none".to_owned(),
        play => play.to_string(),
    };
    [
        ("state", said(&|view| view.state.to_string()), state.phase.to_string()),
        ("half", said(&|view| half(view.first_half)), half(state.half == 1)),
        ("score", said(&|view| score(view.score)), score(state.score)),
        ("time left", said(&|view| clock_text(f64::from(view.seconds_left))), clock_text(state.time_left)),
        ("kick-off", said(&|view| view.kicking.map_or("nobody".into(), team)), kicks_off),
        ("phase", said(&|view| view.game_phase.to_string()), String::new()),
        ("play", said(&|view| stops(view.stopped)), stops(state.restraints.stopped)),
        ("set play", said(&play), held_back(state)),
    ]
}

/// Minutes and seconds, also of a clock that has run over.
fn clock_text(seconds: f64) -> String {
    let whole = seconds.abs().ceil() as u64;
    let sign = if seconds < 0.0 { "−" } else { "" };
    format!("{sign}{:02}:{:02}", whole / 60, whole % 60)
}

/// Who may not move for a set play.
fn held_back(state: &MatchState) -> String {
    match state.restraints.held_back.len() {
        0 => String::new(),
        1 => "1 robot is held back".into(),
        robots => format!("{robots} robots are held back"),
    }
}

fn show_order(ui: &mut egui::Ui, robot: RobotId, orders: &Orders, state: &MatchState) {
    let is_off = state.removed.iter().any(|removal| removal.robot == robot);
    let more = match orders.place {
        _ if is_off => off_text(state, robot),
        _ if state.restraints.is_frozen(robot) => "penalised, stands where it is".into(),
        Some(place) if orders.state == crate::robot::RobotState::Ready => {
            let [x, y] = format::coordinates(place.position);
            format!("to {x}, {y} m")
        }
        _ => String::new(),
    };
    let cells = [robot.to_string(), orders.state.to_string(), more];
    let shown = row(ui, &ORDERS, cells);
    let bar = shown.rect.with_max_x(shown.rect.left() - 3.0).with_min_x(shown.rect.left() - 6.0);
    ui.painter().rect_filled(
        bar.shrink2(egui::vec2(0.0, 2.0)),
        1.0,
        colours::egui(colours::team(robot.team)),
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::referee::RuleBook;

    #[test]
    fn a_clock_that_has_run_over_is_negative() {
        assert_eq!(clock_text(61.0), "01:01");
        assert_eq!(clock_text(-3.0), "−00:03");
    }

    #[test]
    fn without_a_box_only_the_match_is_told() {
        let state = MatchState::new(Team::Away, &RuleBook::default());
        let rows = rows(None, &state);
        assert!(rows.iter().all(|(_, said, _)| said.is_none()));
        assert_eq!((rows[2].2.as_str(), rows[4].2.as_str()), ("0 : 0", "away"));
    }

    #[test]
    fn every_packet_stands_beside_its_own_fate() {
        let heard = PacketCounts { news: 1, not_ours: 3, stale: 7, ..PacketCounts::default() };
        let named: Vec<_> = FATES.iter().map(|(name, _)| *name).zip(fates(&heard)).collect();
        assert_eq!((named[0], named[2], named[7]), (("news", 1), ("of something else", 3), ("overtaken", 7)));
    }
}
