//! From a treatment, a list of changes, to the match that is played.

use std::path::Path;
use std::sync::Arc;

use xxhash_rust::xxh3::Xxh3;

use super::file::{DesignChange, PlacedChange};
use super::metric::{MatchFigures, Metric};
use super::row::MatchResult;
use crate::data::{
    AssetFolder, AssetKind, AssetTexts, DataError, Field, NumberToken, Segment, Source, no_such, numbers,
    with_number,
};
use crate::game::requests::Request;
use crate::game::{Choice, Match, MatchPlan, TeamPlan, file_named};
use crate::ids::Team;
use crate::lab::scenario::{Dependency, TimedEvent, check_event_of_match, has, requests, switch_off};
use crate::lab::unbroken::unbroken;

/// A treatment that can be played.
#[derive(Clone, Debug)]
pub(in crate::lab) struct TreatmentPlan {
    /// With the teams on their own sides, and on each other's.
    plans: [MatchPlan; 2],
    /// The files of the strategies, as they are named.
    pub strategies: [String; 2],
    /// Of the texts of all files that the match was read from with their places in the asset folder, and of what is changed.
    pub assets: u64,
}

impl TreatmentPlan {
    /// Reads everything that its matches need.
    ///
    /// # Errors
    /// The first fault of a file, or the first change that changes nothing.
    pub fn read(
        assets: &AssetFolder,
        design: &Source,
        changes: &[PlacedChange],
    ) -> Result<TreatmentPlan, DataError> {
        let choice = choice(assets, design, changes)?;
        let changed =
            |whose| changed_texts(assets, design, changes, whose).map(|texts| assets.with_texts(texts));
        let (assets, notes) = changed(None)?.noting();
        let mut plan = MatchPlan::read(&assets, &choice)?;
        for team in Team::BOTH.into_iter().filter(|team| has_own_numbers(*team, changes)) {
            let own = MatchPlan::read(&changed(Some(team))?, &choice)?;
            plan.teams[team.index()] = own.teams[team.index()].clone();
        }
        let mut script = Vec::new();
        for (at, change) in changes {
            match change {
                DesignChange::Without(team, what) => {
                    take_out(&mut plan, *team, *what).map_err(|message| design.error_at(at, message))?;
                }
                DesignChange::Event(event) => {
                    check_event_of_match(&assets, (design, &at.key("Event")), event, &plan)?;
                    script.push(event.clone());
                }
                _ => {}
            }
        }
        let mut swapped = plan.clone();
        swapped.teams.swap(0, 1);
        plan.script = in_order(requests(&assets, &script, &plan)?);
        swapped.script = in_order(requests(&assets, &with_sides_swapped(&script), &swapped)?);
        let strategies = plan.teams.each_ref().map(|team| team.names.strategy.clone());
        let assets = hash(assets.root(), &notes.texts(), changes);
        Ok(TreatmentPlan { plans: [plan, swapped], strategies, assets })
    }

    /// The team that is named first.
    pub fn home(&self) -> &TeamPlan {
        &self.plans[0].teams[0]
    }

    /// Whether nothing in its matches is otherwise than in those of another one, whatever files there are beside those that were read.
    pub fn plays_as(&self, other: &TreatmentPlan) -> bool {
        let mut plans = self.plans.iter().zip(&other.plans);
        plans.all(|(plan, other)| MatchPlan { assets: other.assets.clone(), ..plan.clone() } == *other)
    }

    /// Plays the match with a seed. One that breaks the program is an error that says so.
    pub fn play(&self, seed: u64, swapped: bool) -> Result<MatchResult, String> {
        let plan = MatchPlan { seed, ..self.plans[usize::from(swapped)].clone() };
        unbroken(|| play(&plan, swapped))
    }
}

fn play(plan: &MatchPlan, swapped: bool) -> MatchResult {
    let mut game = Match::new(plan);
    while !game.is_over() {
        game.tick();
    }
    let sides = if swapped { [Team::Away, Team::Home] } else { Team::BOTH };
    let figures = MatchFigures::of(&game);
    let values = sides.map(|team| Metric::ALL.iter().map(|metric| metric.value(figures, team)).collect());
    let (record, clock) = (game.record(), game.clock());
    MatchResult { digest: record.digest, seconds: clock.now(), played: record.played, values }
}

/// Whether a number of a file is another for this team alone.
fn has_own_numbers(team: Team, changes: &[PlacedChange]) -> bool {
    changes
        .iter()
        .any(|(_, change)| matches!(change, DesignChange::TeamNumber { team: whose, .. } if *whose == team))
}

/// The files that are other than in the asset folder, for both teams or as one of them alone has them.
fn changed_texts(
    assets: &AssetFolder,
    design: &Source,
    changes: &[PlacedChange],
    whose: Option<Team>,
) -> Result<AssetTexts, DataError> {
    let mut texts = AssetTexts::new();
    for (at, change) in changes {
        let at = fields_of(at, change);
        let text_of = |texts: &AssetTexts, field: &str, name: &str| {
            let path = assets.root().join(name);
            let text = match texts.get(&path) {
                Some(text) => text.clone(),
                None if !assets.has_file(&path) => {
                    let message = format!("{}: no such file", path.display());
                    return Err(design.error_at(&at.key(field), message));
                }
                None => assets.read(&path)?.text.to_string(),
            };
            Ok((path, text))
        };
        match change {
            DesignChange::TeamNumber { team, .. } if whose != Some(*team) => {}
            DesignChange::Number { file, path, to } | DesignChange::TeamNumber { file, path, to, .. } => {
                let (place, text) = text_of(&texts, "file", file)?;
                let number =
                    number_at(&text, path).map_err(|message| design.error_at(&at.key("path"), message))?;
                texts.insert(place, with_number(&text, &number, *to));
            }
            DesignChange::Instead { of, read } => {
                let (_, text) = text_of(&texts, "read", read)?;
                let (place, _) = text_of(&texts, "of", of)?;
                texts.insert(place, text);
            }
            _ => {}
        }
    }
    Ok(texts)
}

/// Where a change names its number or its file: in the change itself, but for the values of a factor.
pub(super) fn fields_of(at: &Field, change: &DesignChange) -> Field {
    match change {
        DesignChange::Number { .. } if !is_values(at) => at.key("Number"),
        DesignChange::TeamNumber { .. } => at.key("TeamNumber"),
        DesignChange::Instead { .. } => at.key("Instead"),
        _ => at.clone(),
    }
}

/// The number of a text with this path.
///
/// # Errors
/// If there is none: which there are.
pub(in crate::lab) fn number_at(text: &str, path: &str) -> Result<NumberToken, String> {
    let mut known = numbers(text);
    match known.iter().position(|number| number.field.to_string() == path) {
        Some(place) => Ok(known.swap_remove(place)),
        None => Err(no_such("number", path, known.iter().map(|number| number.field.to_string()))),
    }
}

/// Whether a change is one of the values of a factor.
pub(super) fn is_values(at: &Field) -> bool {
    matches!(at.segments().last(), Some(Segment::Key(key)) if key == "Values")
}

/// What is chosen of the match; a later change has its way.
fn choice(assets: &AssetFolder, design: &Source, changes: &[PlacedChange]) -> Result<Choice, DataError> {
    let mut choice = Choice::default();
    for (at, change) in changes {
        let (kind, field, name, chosen) = match change {
            DesignChange::Match(name) => (AssetKind::Match, "Match", name, &mut choice.file),
            DesignChange::Home(name) => (AssetKind::Strategy, "Home", name, &mut choice.home),
            DesignChange::Away(name) => (AssetKind::Strategy, "Away", name, &mut choice.away),
            DesignChange::Radio(name) => (AssetKind::Radio, "Radio", name, &mut choice.radio),
            DesignChange::HalfMinutes(minutes) => {
                choice.half_minutes = Some(*minutes);
                continue;
            }
            _ => continue,
        };
        file_named(assets, design, kind, (&at.key(field), name))?;
        *chosen = Some(name.clone());
    }
    Ok(choice)
}

fn take_out(plan: &mut MatchPlan, team: Team, what: Dependency) -> Result<(), String> {
    let strategy = &mut plan.teams[team.index()].strategy;
    if !has(strategy, what) {
        return Err(format!("{what} is not on in {}", strategy.name));
    }
    switch_off(Arc::make_mut(strategy), what);
    Ok(())
}

fn with_sides_swapped(script: &[TimedEvent]) -> Vec<TimedEvent> {
    let swapped = |event: &TimedEvent| TimedEvent { at: event.at, what: event.what.with_sides_swapped() };
    script.iter().map(swapped).collect()
}

fn in_order(mut script: Vec<(u64, Request)>) -> Vec<(u64, Request)> {
    script.sort_by_key(|(tick, _)| *tick);
    script
}

fn hash(root: &Path, texts: &AssetTexts, changes: &[PlacedChange]) -> u64 {
    let mut hash = Xxh3::new();
    let mut add = |part: &str| {
        // Its length keeps it from what comes next.
        hash.update(&(part.len() as u64).to_le_bytes());
        hash.update(part.as_bytes());
    };
    for (path, text) in texts {
        add(&path.strip_prefix(root).unwrap_or(path).to_string_lossy());
        add(text);
    }
    for (_, change) in changes {
        add(&format!("{change:?}"));
    }
    hash.digest()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::experiment::file::placed;

    fn read(changes: &[DesignChange]) -> TreatmentPlan {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        TreatmentPlan::read(&assets, &Source::new("a.ron", ""), &placed(&Field::root(), changes)).unwrap()
    }

    #[test]
    fn a_number_of_a_team_is_not_its_opponents_whatever_files_they_share() {
        let file = String::from("strategies/hammerheads_2001.ron");
        let path = String::from("schemas.dock.DockBehind.standoff");
        let teams =
            || [DesignChange::Home("hammerheads_swap".into()), DesignChange::Away("hammerheads_2000".into())];
        let shipped = read(&teams());
        let changed = |team| {
            let own = DesignChange::TeamNumber { team, file: file.clone(), path: path.clone(), to: 0.5 };
            read(&[teams().as_slice(), &[own]].concat())
        };
        for (team, other) in [(Team::Home, Team::Away), (Team::Away, Team::Home)] {
            let changed = changed(team);
            assert_ne!(changed.assets, shipped.assets);
            for (swapped, (plan, before)) in changed.plans.iter().zip(&shipped.plans).enumerate() {
                let side = |team: Team| (team.index() + swapped) % 2;
                let strategy = |plan: &MatchPlan, team| plan.teams[side(team)].strategy.clone();
                assert_ne!(strategy(plan, team), strategy(before, team));
                assert_eq!(strategy(plan, other), strategy(before, other));
            }
        }
        let number = DesignChange::Number { file: file.clone(), path: path.clone(), to: 0.5 };
        let both = read(&[teams().as_slice(), &[number]].concat());
        for team in Team::BOTH {
            let [own, shared] =
                [changed(team), both.clone()].map(|plan| plan.plans[0].teams[team.index()].strategy.clone());
            assert_eq!(own, shared);
        }
    }

    #[test]
    fn a_match_that_breaks_the_program_is_an_error_and_the_next_one_is_played() {
        let mut plan = read(&[DesignChange::HalfMinutes(0.01)]);
        // A role that is not there: no file comes to that.
        Arc::make_mut(&mut plan.plans[0].teams[0].strategy).players.fill(usize::MAX);
        let error = plan.play(1, false).expect_err("there is no such role");
        assert!(error.contains("index out of bounds"), "{error}");
        assert!(plan.play(1, true).is_ok(), "the other match has its roles");
    }
}
