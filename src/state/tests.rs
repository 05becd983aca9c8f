//! Two components and a resource of a small match.

use super::*;
use crate::ids::MatchEntity;

#[derive(Component, Clone, Debug, PartialEq)]
struct Steps(u32);

#[derive(Component, Clone, Debug, PartialEq)]
struct Echo(u32);

#[derive(Resource, Clone, Debug, Default, PartialEq)]
struct Total(u32);

struct Arrives(u32);

struct Walks;

fn app() -> App {
    let mut app = App::new();
    app.match_component::<Steps>()
        .starts(|arrives: &Arrives, _| Steps(arrives.0))
        .on(|steps, _: &Walks, _| steps.0 += 1);
    app.match_component::<Echo>()
        .may_start(|arrives: &Arrives, _| (arrives.0 > 0).then_some(Echo(0)))
        .on(|echo, _: &Walks, owner| echo.0 = owner.get::<Steps>().map_or(0, |steps| steps.0));
    app.match_resource::<Total>();
    app
}

fn arrive(world: &mut World, name: &'static str, steps: u32) -> Entity {
    let entity = world.spawn((MatchEntity, Name::new(name))).id();
    apply_event(world, entity, &Arrives(steps));
    entity
}

#[test]
fn a_component_sees_what_those_before_it_have_become() {
    let mut app = app();
    let [walker, quiet] =
        [("walker", 3), ("quiet", 0)].map(|(name, steps)| arrive(app.world_mut(), name, steps));
    app.world_mut().commands().entity(walker).queue(event(Walks));
    app.world_mut().commands().entity(quiet).queue(event(Walks));
    app.world_mut().flush();
    let world = app.world();
    assert_eq!((world.get(walker), world.get(walker)), (Some(&Steps(4)), Some(&Echo(4))));
    assert_eq!((world.get(quiet), world.get::<Echo>(quiet)), (Some(&Steps(1)), None));
}

#[test]
fn what_passed_by_comes_back_and_what_came_later_is_gone() {
    let mut app = app();
    let world = app.world_mut();
    let walker = arrive(world, "walker", 1);
    world.spawn((MatchEntity, Steps(7)));
    let snapshot = Snapshot::take(world);
    apply_event(world, walker, &Walks);
    world.insert_resource(Total(1));
    world.entity_mut(walker).remove::<Echo>();
    let mut passing = world.query_filtered::<(Entity, &Steps), Without<Name>>();
    let gone = passing.single(world).map(|(entity, _)| entity).unwrap();
    world.despawn(gone);
    world.spawn((MatchEntity, Steps(8)));
    snapshot.restore(world).unwrap();
    assert_eq!((world.get(walker), world.get(walker)), (Some(&Steps(1)), Some(&Echo(0))));
    assert_eq!(passing.single(world).map(|(_, steps)| steps.0).ok(), Some(7));
    assert_eq!(world.get_resource::<Total>(), None);
    assert_eq!(snapshot.difference(&Snapshot::take(world)), None);
}

#[test]
fn a_resource_that_the_world_has_not_had_yet_is_put_back() {
    let mut full = app();
    full.insert_resource(Total(5));
    let snapshot = Snapshot::take(full.world_mut());
    let mut empty = app();
    snapshot.restore(empty.world_mut()).unwrap();
    assert_eq!(empty.world().get_resource(), Some(&Total(5)));
}

#[test]
fn a_difference_names_entity_component_and_line() {
    let mut app = app();
    let walker = arrive(app.world_mut(), "walker", 1);
    let before = Snapshot::take(app.world_mut());
    apply_event(app.world_mut(), walker, &Walks);
    let after = Snapshot::take(app.world_mut());
    assert_ne!(before.digest(), after.digest());
    let difference = before.difference(&after).unwrap();
    assert_eq!(difference.to_string(), "walker's Steps: `1,` and then `2,`");
}

#[derive(Resource, Clone, Debug, PartialEq)]
struct Other(u32);

#[test]
fn a_match_is_put_back_into_a_world_that_has_more_in_it_and_numbers_its_types_otherwise() {
    let mut first = app();
    first.insert_resource(Total(5));
    arrive(first.world_mut(), "walker", 3);
    let snapshot = Snapshot::take(first.world_mut());
    let mut second = App::new();
    second.insert_resource(Other(7)).insert_resource(Total(0));
    second.match_resource::<Total>();
    second.match_component::<Steps>().starts(|arrives: &Arrives, _| Steps(arrives.0));
    let walker = arrive(second.world_mut(), "walker", 1);
    snapshot.restore(second.world_mut()).unwrap();
    let world = second.world();
    assert_eq!((world.get(walker), world.get(walker)), (Some(&Steps(3)), Some(&Echo(0))));
    assert_eq!((world.resource::<Total>(), world.resource::<Other>()), (&Total(5), &Other(7)));
}
