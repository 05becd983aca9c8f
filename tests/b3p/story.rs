//! Tells what happened in plain sentences.

use touchline::ids::PlayerNumber;

use super::model::{Action, Robot, State};

pub struct Story(Vec<String>);

impl Story {
    /// Tells a path of states, each with the step that leaves it.
    pub fn told(path: &[(State, Option<Action>)]) -> Story {
        let steps = path.windows(2).map(|pair| (&pair[0], &pair[1].0));
        let sentences: Vec<String> = steps
            .filter_map(|((before, action), after)| Some(sentence(before, action.as_ref()?, after)))
            .collect();
        for (step, sentence) in sentences.iter().enumerate() {
            println!("{:3}. {sentence}", step + 1);
        }
        Story(sentences)
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether a sentence contains these words.
    pub fn tells(&self, words: &str) -> bool {
        self.0.iter().any(|sentence| sentence.contains(words))
    }
}

fn sentence(before: &State, action: &Action, after: &State) -> String {
    let message = |place: &usize| {
        let envelope = &before.in_flight[*place];
        let release = envelope.book.distance.is_infinite();
        (if release { "release" } else { "booking" }, envelope.from, envelope.to)
    };
    match action {
        Action::Turn { robot, .. } => {
            let said = after.in_flight.len() > before.in_flight.len();
            let what = if after.robot(*robot).sees { "books the ball" } else { "releases the ball" };
            format!(
                "R{robot} turns{}{}",
                if said { format!(", {what}") } else { String::new() },
                outcome(before, after, *robot)
            )
        }
        Action::Deliver(place) => {
            let (what, from, to) = message(place);
            let believes = before.robot(to) != after.robot(to);
            let reaction = if believes { "which believes it" } else { "which ignores it" };
            format!("a {what} of R{from} reaches R{to}, {reaction}{}", outcome(before, after, to))
        }
        Action::Lose(place) => {
            let (what, from, to) = message(place);
            format!("the radio loses a {what} of R{from} to R{to}")
        }
        Action::Tick => "the tick ends".to_owned(),
        Action::Kick(place) => format!("the ball rolls to distances {place:?}"),
        Action::Crash(robot) => format!("R{robot} crashes"),
        Action::Blind(robot) => format!("R{robot} loses sight of the ball"),
    }
}

fn outcome(before: &State, after: &State, robot: PlayerNumber) -> &'static str {
    let goes = |state: &State| Robot::goes(state.robot(robot));
    match (goes(before), goes(after)) {
        (false, true) => ": it goes",
        (true, false) => ": it stops",
        _ => "",
    }
}
