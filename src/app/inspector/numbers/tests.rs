//! The numbers under a person's hands, in a match without a window.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use bevy_egui::egui::{self, Event, Key, Modifiers, Pos2, pos2, vec2};

use super::view::{NumberDesk, RunningTexts, draw};
use crate::app::inspector::vision::hand::{DrawnFrame, Hand, click, key};
use crate::data::{AssetFolder, AssetKind, numbers};
use crate::game::requests::{Request, Requests};
use crate::game::{Choice, Match, MatchPlan};
use crate::ids::Team;
use crate::strategy::{Strategies, StrategySources};

/// The panel of the home team, and the match that does what it asks for.
struct Tuning {
    hand: Hand,
    desk: NumberDesk,
    plan: MatchPlan,
    game: Match,
}

/// Where the home team's strategy is.
const FILE: &str = "strategies/mine.ron";

impl Tuning {
    /// A match whose home team plays a strategy of its own.
    fn of(folder: &Path) -> Tuning {
        let shipped = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        for kind in AssetKind::ALL {
            let there = folder.join(kind.folder());
            fs::create_dir_all(&there).unwrap();
            for file in shipped.files(kind).unwrap() {
                fs::copy(&file, there.join(file.file_name().unwrap())).unwrap();
            }
        }
        fs::copy(shipped.file(AssetKind::Strategy, "ball_chasers"), folder.join(FILE)).unwrap();
        let choice = Choice { home: Some("mine".into()), ..Choice::default() };
        let plan = MatchPlan::read(&AssetFolder::new(folder), &choice).unwrap();
        let hand = Hand::on(vec2(500.0, 700.0));
        let mut tuning = Tuning { hand, desk: NumberDesk::default(), game: Match::new(&plan), plan };
        tuning.frame(Vec::new());
        tuning
    }

    fn frame(&mut self, events: Vec<Event>) -> DrawnFrame {
        let running = self.game.world().resource::<StrategySources>().0[0].clone();
        let Tuning { hand, desk, plan, game } = self;
        let mut requests = game.world_mut().resource_mut::<Requests>();
        hand.frame(events, |ctx, screen| {
            let place = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(screen);
            let mut ui = egui::Ui::new(ctx.clone(), egui::Id::new("panel"), place);
            draw(&mut ui, RunningTexts { team: Team::Home, running: &running, plan }, desk, &mut requests);
        })
    }

    fn click(&mut self, at: Pos2) {
        for events in click(at, egui::PointerButton::Primary, Modifiers::default()) {
            self.frame(events);
        }
    }

    fn click_on(&mut self, text: &str) {
        let at = self.frame(Vec::new()).place_of(text).center();
        self.click(at);
    }

    /// Looks for a number, clicks it and types another.
    fn type_number(&mut self, path: &str, value: &str) {
        self.desk.filter = path.into();
        let drawn = self.frame(Vec::new());
        // The first one is what is looked for.
        let beside = drawn.texts.iter().rfind(|(shown, _)| shown == path).expect("it is shown").1;
        self.click(pos2(500.0 - 60.0, beside.center().y));
        self.frame(key(Key::A, Modifiers::COMMAND));
        self.frame(vec![Event::Text(value.into())]);
        self.frame(key(Key::Enter, Modifiers::default()));
        self.frame(Vec::new());
    }

    fn asked(&self) -> usize {
        let requests = self.game.world().resource::<Requests>();
        requests.iter().filter(|request| matches!(request, Request::ChangeStrategy { .. })).count()
    }

    /// What the running strategy says at a path.
    fn running(&self, path: &str) -> f64 {
        let sources = self.game.world().resource::<StrategySources>();
        let text = sources.0[0].files[&sources.0[0].path].clone();
        let all = numbers(&text);
        all.iter().find(|number| number.field.to_string() == path).expect("it has such a number").value
    }
}

/// Whether a text is shown, alone or within another.
fn says(drawn: &DrawnFrame, text: &str) -> bool {
    drawn.texts.iter().any(|(shown, _)| shown.contains(text))
}

/// The path and the value of a speed in the file.
fn speed(folder: &Path) -> (String, f64) {
    let text = fs::read_to_string(folder.join(FILE)).unwrap();
    let found = numbers(&text).into_iter().find(|number| number.field.to_string().ends_with(".speed"));
    let number = found.expect("chasers have a speed");
    (number.field.to_string(), number.value)
}

#[test]
fn a_number_is_typed_runs_from_the_next_tick_on_and_is_undone() {
    let folder = tempfile::tempdir().unwrap();
    let mut tuning = Tuning::of(folder.path());
    let (path, filed) = speed(folder.path());
    let before = tuning.game.world().resource::<Strategies>().0[0].clone();
    tuning.type_number(&path, "0.25");
    assert_eq!(tuning.asked(), 1, "one request");
    tuning.game.tick();
    assert_eq!(tuning.running(&path), 0.25);
    assert!(!Arc::ptr_eq(&before, &tuning.game.world().resource::<Strategies>().0[0]));
    tuning.desk.filter.clear();
    tuning.desk.only_changed = true;
    let drawn = tuning.frame(Vec::new());
    assert!(says(&drawn, &path) && says(&drawn, "changed (1)"));
    tuning.click_on("Undo");
    tuning.game.tick();
    assert_eq!(tuning.running(&path), filed);
    assert!(says(&tuning.frame(Vec::new()), "changed (0)"));
}

#[test]
fn a_weight_that_a_slider_has_set_is_a_number_of_the_text_and_stays_when_another_is_typed() {
    const WEIGHT: &str = "assemblages.acquire.WeightedSum[0][1][0]";
    let folder = tempfile::tempdir().unwrap();
    let mut tuning = Tuning::of(folder.path());
    let (speed, _) = speed(folder.path());
    let in_force = |tuning: &Tuning| {
        let strategy = &tuning.game.world().resource::<Strategies>().0[0];
        let acquire = strategy.assemblages.iter().position(|found| found.name == "acquire").unwrap();
        (acquire, strategy.assemblages[acquire].terms[1].weight)
    };
    let (assemblage, filed) = in_force(&tuning);
    assert_eq!(tuning.running(WEIGHT) as f32, filed);
    let slid = Request::SetWeight { team: Team::Home, assemblage, term: 1, weight: 0.75 };
    tuning.game.world_mut().resource_mut::<Requests>().ask(slid);
    tuning.game.tick();
    assert_eq!((tuning.running(WEIGHT), in_force(&tuning).1), (0.75, 0.75));
    assert!(says(&tuning.frame(Vec::new()), "changed (1)"));
    tuning.type_number(&speed, "0.25");
    tuning.game.tick();
    assert_eq!((tuning.running(&speed), in_force(&tuning).1), (0.25, 0.75));
    tuning.click_on("Save");
    let saved = numbers(&fs::read_to_string(folder.path().join(FILE)).unwrap());
    let saved = saved.iter().find(|number| number.field.to_string() == WEIGHT);
    assert_eq!(saved.map(|number| number.value), Some(0.75));
}

#[test]
fn a_number_that_no_file_may_have_is_told_and_not_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let mut tuning = Tuning::of(folder.path());
    let (path, filed) = speed(folder.path());
    tuning.type_number(&path, "1e9");
    assert_eq!(tuning.asked(), 0);
    assert!(says(&tuning.frame(Vec::new()), "mine.ron:"), "the error names the file and the line");
    tuning.game.tick();
    assert_eq!(tuning.running(&path), filed);
}

#[test]
fn changed_numbers_are_saved_and_nothing_else_of_the_file_changes() {
    let folder = tempfile::tempdir().unwrap();
    let mut tuning = Tuning::of(folder.path());
    let (path, filed) = speed(folder.path());
    let file = folder.path().join(FILE);
    let before = fs::read_to_string(&file).unwrap();
    tuning.type_number(&path, "0.25");
    // Somebody writes a comment meanwhile.
    let commented = format!("// A thought.\n{before}");
    fs::write(&file, &commented).unwrap();
    tuning.game.tick();
    tuning.click_on("Save");
    let after = fs::read_to_string(&file).unwrap();
    let number = numbers(&commented).into_iter().find(|number| number.field.to_string() == path).unwrap();
    assert_eq!(number.value, filed);
    let expected = [&commented[..number.span.start], "0.25", &commented[number.span.end..]].concat();
    assert_eq!(after, expected);
    // Somebody takes a number out.
    let other = after.replacen("0.25", "Inf", 1);
    fs::write(&file, &other).unwrap();
    tuning.click_on("Save");
    assert_eq!(fs::read_to_string(&file).unwrap(), other);
    assert!(says(&tuning.frame(Vec::new()), "has other numbers now"));
}
