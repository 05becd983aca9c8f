//! Assemblages: motor schemas looked up, and assemblages within others.

use super::{Resolved, Resolver, unknown};
use crate::data::{Bound, Field};
use crate::strategy::desirability::Desirability;
use crate::strategy::file::{AssemblageFile, BlendedFile};
use crate::strategy::pieces::{Assemblage, Combination, Influence, Term};

impl Resolver<'_> {
    pub(super) fn assemblage(
        &mut self,
        name: &str,
        file: &AssemblageFile,
        at: &Field,
    ) -> Resolved<Assemblage> {
        let (combination, terms) = match file {
            AssemblageFile::WeightedSum(terms) => {
                (Combination::WeightedSum, self.schemas(terms, &at.key("WeightedSum"))?)
            }
            AssemblageFile::WinnerTakeAll(terms) => {
                (Combination::WinnerTakeAll, self.schemas(terms, &at.key("WinnerTakeAll"))?)
            }
            AssemblageFile::Blend(parts) => (Combination::Blend, self.blend(name, parts, &at.key("Blend"))?),
        };
        Ok(Assemblage { name: name.into(), combination, terms })
    }

    fn schemas(&mut self, terms: &[(f32, String)], at: &Field) -> Resolved<Vec<Term>> {
        let terms = terms.iter().enumerate();
        terms.map(|(i, (weight, schema))| self.schema_term(*weight, schema, &at.index(i))).collect()
    }

    fn schema_term(&mut self, weight: f32, name: &str, at: &Field) -> Resolved<Term> {
        self.within(weight, Bound::WEIGHT, &at.index(0))?;
        let schema = self.expand(&self.file.schemas, "schema", name, &at.index(1), |s, schema| {
            s.schema(schema, &Field::root().key("schemas").key(name))
        })?;
        Ok(Term { weight, name: name.into(), influence: Influence::Schema(schema) })
    }

    fn blend(&mut self, name: &str, parts: &[BlendedFile], at: &Field) -> Resolved<Vec<Term>> {
        self.open.push(format!("assemblage {name}"));
        let terms = parts.iter().enumerate().map(|(i, part)| self.blended(part, &at.index(i)));
        let terms = terms.collect::<Resolved<_>>()?;
        self.open.pop();
        Ok(terms)
    }

    fn blended(&mut self, part: &BlendedFile, at: &Field) -> Resolved<Term> {
        self.within(part.weight, Bound::WEIGHT.positive(), &at.key("weight"))?;
        let index = self.index(&self.file.assemblages, "assemblage", &part.run, &at.key("run"))?;
        self.ends(&part.run, &at.key("run"))?;
        let mut desirability = part.desirability.clone();
        self.desirability(&mut desirability, &at.key("desirability"))?;
        let influence = Influence::Assemblage { index, desirability };
        Ok(Term { weight: part.weight, name: part.run.clone(), influence })
    }

    /// An assemblage within another does not hold that in turn, and the two together are not too large.
    fn ends(&mut self, name: &str, at: &Field) -> Resolved<()> {
        let Some(file) = self.file.assemblages.get(name) else {
            return self.fault(at, unknown(&self.file.assemblages, "assemblage", name));
        };
        let AssemblageFile::Blend(parts) = file else { return self.nested(at, |_| Ok(())) };
        let key = format!("assemblage {name}");
        if self.open.contains(&key) {
            return self.fault(at, format!("`{name}` is a blend of itself"));
        }
        self.open.push(key);
        self.nested(at, |s| parts.iter().try_for_each(|part| s.ends(&part.run, at)))?;
        self.open.pop();
        Ok(())
    }

    fn desirability(&mut self, desirability: &mut Desirability, at: &Field) -> Resolved<()> {
        self.nested(at, |s| s.desirability_inside(desirability, at))
    }

    fn desirability_inside(&mut self, desirability: &mut Desirability, at: &Field) -> Resolved<()> {
        match desirability {
            Desirability::Degree(degree) => self.within(*degree, Bound::SHARE, at),
            Desirability::If(feature) => self.feature(feature, &at.index(0)),
            Desirability::Distance { a, b, full, none } => {
                self.point(a, &at.key("a"))?;
                self.point(b, &at.key("b"))?;
                self.within(*full, Bound::LENGTH, &at.key("full"))?;
                self.within(*none, Bound::LENGTH, &at.key("none"))?;
                if full == none {
                    return self.fault(&at.key("none"), format!("must not be the same as full, {full} m"));
                }
                Ok(())
            }
            Desirability::Not(of) => self.desirability(of, &at.index(0)),
            Desirability::All(parts) | Desirability::Any(parts) => {
                let mut parts = parts.iter_mut().enumerate();
                parts.try_for_each(|(i, part)| self.desirability(part, &at.index(i)))
            }
        }
    }
}
