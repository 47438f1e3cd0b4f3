//! Moves parameters against their gradients by Adam (Kingma & Ba 2015): rows of their own ages, values within limits.

use crate::error::Error;
use crate::scene::length;

/// Arrays of one shape `[n, m]`: parameters, and the moments that their rows have collected.
#[derive(Debug)]
pub struct Adam<'a> {
    pub values: &'a mut [f32],
    pub first: &'a mut [f32],
    pub second: &'a mut [f32],
}

/// What a step goes by: rates and limits of the parameters of a row, `[m]`, and what is the same for all.
#[derive(Debug, Clone, Copy)]
pub struct Rule<'a> {
    pub rate: &'a [f32],
    pub least: &'a [f32],
    pub most: &'a [f32],
    /// Decays of the first and the second moment.
    pub betas: [f32; 2],
    pub epsilon: f32,
}

impl Adam<'_> {
    /// One step against `gradient [n, m]`; `age [n]` counts each row's steps, this one included.
    ///
    /// A row's bias correction starts when it does, so that new rows do not reset the old ones'.
    pub fn step(&mut self, gradient: &[f32], age: &[i64], rule: &Rule<'_>) -> Result<(), Error> {
        let m = rule.rate.len();
        let of_row = [("least", rule.least), ("most", rule.most)];
        let of_all =
            [("values", &*self.values), ("first", self.first), ("second", self.second), ("gradient", gradient)];
        of_row.into_iter().try_for_each(|(name, values)| length(name, values, m))?;
        of_all.into_iter().try_for_each(|(name, values)| length(name, values, m * age.len()))?;
        if m == 0 {
            return Ok(());
        }
        let values = self.values.chunks_exact_mut(m).zip(gradient.chunks_exact(m));
        let moments = self.first.chunks_exact_mut(m).zip(self.second.chunks_exact_mut(m));
        for (((values, gradient), (first, second)), &age) in values.zip(moments).zip(age) {
            let [unbiased1, unbiased2] = rule.betas.map(|beta| 1.0 / (1.0 - beta.powi(age as i32)));
            for i in 0..m {
                let g = gradient[i];
                first[i] += (1.0 - rule.betas[0]) * (g - first[i]);
                second[i] += (1.0 - rule.betas[1]) * (g * g - second[i]);
                let step = rule.rate[i] * unbiased1 * first[i] / ((second[i] * unbiased2).sqrt() + rule.epsilon);
                values[i] = (values[i] - step).max(rule.least[i]).min(rule.most[i]);
            }
        }
        Ok(())
    }
}
