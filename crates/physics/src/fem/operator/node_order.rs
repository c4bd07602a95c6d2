//! An order of nodes in which neighbours lie close together.

/// Order of Cuthill and McKee, breadth first from a node far out, neighbours by rising degree: what a row of the matrix
/// reads was read shortly before. `neighbours[i]` are the nodes beside node `i`, both ways round; bodies follow one another.
///
/// Returns the nodes in their new order.
///
/// Source: E. Cuthill, J. McKee, Reducing the bandwidth of sparse symmetric matrices, Proc. 24th ACM Conf. (1969).
pub(super) fn cuthill_mckee(neighbours: &[Vec<u32>]) -> Vec<u32> {
    let mut order = Vec::with_capacity(neighbours.len());
    let mut is_placed = vec![false; neighbours.len()];
    for node in 0..neighbours.len() as u32 {
        if neighbours[node as usize].is_empty() {
            order.push(node);
        } else if !is_placed[node as usize] {
            // The last node of a search from anywhere lies far out.
            let mut search = Vec::new();
            append_levels(neighbours, node, &mut is_placed.clone(), &mut search);
            let far = search.last().copied().unwrap_or(node);
            append_levels(neighbours, far, &mut is_placed, &mut order);
        }
    }
    order
}

/// Appends the nodes connected to `root`, level by level.
fn append_levels(neighbours: &[Vec<u32>], root: u32, is_placed: &mut [bool], order: &mut Vec<u32>) {
    let mut next = order.len();
    order.push(root);
    is_placed[root as usize] = true;
    while next < order.len() {
        let beside = &neighbours[order[next] as usize];
        next += 1;
        let first = order.len();
        for &node in beside {
            if !std::mem::replace(&mut is_placed[node as usize], true) {
                order.push(node);
            }
        }
        order[first..].sort_by_key(|&node| neighbours[node as usize].len());
    }
}

#[cfg(test)]
mod tests {
    use super::cuthill_mckee;

    /// A strip of `width x length` nodes numbered at random, and a second body of one node.
    #[test]
    fn neighbours_of_a_shuffled_strip_lie_within_two_widths() {
        let (width, length) = (7, 40);
        let count = width * length;
        // 97 has no factor in common with 280.
        let number = |i: usize| (97 * i + 13) % count;
        let mut neighbours = vec![Vec::new(); count + 1];
        for i in 0..count {
            for j in 0..count {
                let apart = [i % width, i / width].map(|a| a as i64);
                let apart = [apart[0] - (j % width) as i64, apart[1] - (j / width) as i64];
                if i != j && apart.iter().all(|a| a.abs() <= 1) {
                    neighbours[number(i)].push(number(j) as u32);
                }
            }
        }
        let order = cuthill_mckee(&neighbours);
        let mut place = vec![usize::MAX; count + 1];
        for (k, &node) in order.iter().enumerate() {
            place[node as usize] = k;
        }
        assert!(place.iter().all(|&k| k <= count));
        let reach = neighbours.iter().enumerate().flat_map(|(i, beside)| {
            let place = &place;
            beside.iter().map(move |&j| place[i].abs_diff(place[j as usize]))
        });
        // A level of a diagonal front is at most two columns of the strip.
        assert!(reach.max().unwrap() <= 4 * width);
    }
}
