//! Chooses the frame of reference of every element so that the whole gets smallest.

use super::elements::Reference;

/// For elements in painter's order, written in the picture's and in the head's frame of reference with `[picture, head]`
/// bytes: the cheapest references, when each run of head elements costs `group` bytes more (Viterbi, two states).
#[must_use]
pub fn cheapest_references(bytes: &[[usize; 2]], group: usize) -> Vec<Reference> {
    let mut totals = [0, group];
    let mut stays = Vec::with_capacity(bytes.len()); // whether the best way to [picture, head] comes from the same
    for [picture, head] in bytes {
        let opened = totals[0] + group;
        stays.push([totals[0] <= totals[1], totals[1] <= opened]);
        totals = [totals[0].min(totals[1]) + picture, totals[1].min(opened) + head];
    }
    let mut in_head = totals[1] < totals[0];
    let mut references = vec![Reference::Picture; bytes.len()];
    for (reference, [picture_stays, head_stays]) in references.iter_mut().zip(&stays).rev() {
        if in_head {
            *reference = Reference::Head;
            in_head = *head_stays;
        } else {
            in_head = !picture_stays;
        }
    }
    references
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cost(bytes: &[[usize; 2]], group: usize, references: &[Reference]) -> usize {
        let elements: usize = bytes.iter().zip(references).map(|(b, r)| b[usize::from(*r == Reference::Head)]).sum();
        let runs = references.chunk_by(|a, b| a == b).filter(|run| run[0] == Reference::Head).count();
        elements + runs * group
    }

    proptest! {
        #[test]
        fn no_other_choice_is_cheaper(bytes in prop::collection::vec(prop::array::uniform2(0usize..50), 0..9), group in 0usize..40) {
            let chosen = cost(&bytes, group, &cheapest_references(&bytes, group));
            for choice in 0..1u32 << bytes.len() {
                let reference = |i| if choice >> i & 1 == 1 { Reference::Head } else { Reference::Picture };
                let references: Vec<Reference> = (0..bytes.len()).map(reference).collect();
                prop_assert!(chosen <= cost(&bytes, group, &references));
            }
        }
    }
}
