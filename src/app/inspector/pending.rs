//! Values under a person's hand. A request waits for the next tick, and while time stands still that may take a while; until then
//! a panel shows what was asked for.

use crate::game::requests::{Request, Requests};

/// A value that was asked for and is not yet in force, and the value before it, which is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pending<T> {
    /// By the newest request that waits.
    pub asked: Option<T>,
    pub before: T,
}

impl<T> Pending<T> {
    /// Looks among the requests that wait for those that ask for this value.
    pub fn new(before: T, requests: &Requests, asked: impl Fn(&Request) -> Option<T>) -> Pending<T> {
        Pending { asked: requests.iter().filter_map(asked).last(), before }
    }

    /// The value to show.
    pub fn shown(self) -> T {
        self.asked.unwrap_or(self.before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::{Choice, Match, MatchPlan, start_match};
    use crate::ids::Team;
    use crate::strategy::Strategies;

    const ASKED: Request = Request::SetWeight { team: Team::Away, assemblage: 0, term: 0, weight: 2.5 };

    fn plan() -> MatchPlan {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        MatchPlan::read(&assets, &Choice::default()).expect("the default match")
    }

    fn pending(game: &Match) -> Pending<f32> {
        let in_force = game.world().resource::<Strategies>().of(Team::Away).assemblages[0].terms[0].weight;
        Pending::new(in_force, game.world().resource(), |request| match request {
            Request::SetWeight { team: Team::Away, assemblage: 0, term: 0, weight } => Some(*weight),
            _ => None,
        })
    }

    #[test]
    fn a_value_asked_for_is_shown_until_it_is_in_force() {
        let mut game = Match::new(&plan());
        let first = pending(&game).before;
        game.world_mut().resource_mut::<Requests>().ask(ASKED);
        assert_eq!(pending(&game), Pending { asked: Some(2.5), before: first });
        assert_eq!(pending(&game).shown(), 2.5);
        game.tick();
        assert_eq!(pending(&game), Pending { asked: None, before: 2.5 });
    }

    #[test]
    fn a_new_match_forgets_what_was_asked_for() {
        let mut game = Match::new(&plan());
        let first = pending(&game);
        game.world_mut().resource_mut::<Requests>().ask(ASKED);
        start_match(game.world_mut(), &plan());
        assert_eq!(pending(&game), first);
    }
}
