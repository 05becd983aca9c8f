//! Which treatments are compared: those that differ in one factor alone, each level with the first one.

use crate::lab::experiment::ExperimentFile;

/// Two treatments that differ in the level of one factor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LevelComparison {
    /// That of the first of the treatments; the other has the first level of the factor.
    pub level: String,
    /// The levels of the other factors, which both have.
    pub among: Vec<String>,
    /// Their numbers.
    pub treatments: [usize; 2],
}

/// All of a factor, by its place: for each level but the first, at all levels of the others.
pub(super) fn level_comparisons(file: &ExperimentFile, factor: usize) -> Vec<LevelComparison> {
    let names: Vec<Vec<String>> = file.factors.iter().map(|factor| factor.levels.names()).collect();
    let of_treatment = |treatment: usize| {
        let places = file.places(treatment);
        let mut base = places.clone();
        base[factor] = 0;
        let name = |place: usize| names[place][places[place]].clone();
        (places[factor] > 0).then(|| LevelComparison {
            level: name(factor),
            among: (0..places.len()).filter(|place| *place != factor).map(name).collect(),
            treatments: [treatment, file.treatment_at(&base)],
        })
    };
    let mut all: Vec<LevelComparison> = (0..file.treatments()).filter_map(of_treatment).collect();
    all.sort_by_key(|comparison| comparison.treatments[1]);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_level_is_compared_with_the_first_where_all_else_is_equal() {
        let text = r#"(name: "x", blocks: (first: 1, number: 1), metrics: [Goals], factors: [
            (name: "a", levels: Named([(name: "a0"), (name: "a1")])),
            (name: "b", levels: Values(file: "f", path: "p", values: [0, 1, 2])),
        ])"#;
        let file: ExperimentFile = ron::from_str(text).unwrap();
        let told = |factor| {
            let all = level_comparisons(&file, factor).into_iter();
            all.map(|it| (it.level, it.among[0].clone(), it.treatments)).collect::<Vec<_>>()
        };
        let row = |level: &str, among: &str, treatments| (level.to_owned(), among.to_owned(), treatments);
        let expected = vec![row("a1", "0", [3, 0]), row("a1", "1", [4, 1]), row("a1", "2", [5, 2])];
        assert_eq!(told(0), expected);
        let expected = vec![
            row("1", "a0", [1, 0]),
            row("2", "a0", [2, 0]),
            row("1", "a1", [4, 3]),
            row("2", "a1", [5, 3]),
        ];
        assert_eq!(told(1), expected);
    }
}
