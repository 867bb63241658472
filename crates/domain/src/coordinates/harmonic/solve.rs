//! Least squares with one block of unknowns a cell, coupled between neighbours only.
//!
//! The cells are eliminated one by one: the columns of a cell in all rows that touch it are brought to triangular form
//! by an orthogonal transformation with column exchanges; the upper rows give that cell's unknowns by those of its
//! neighbours, the lower rows remain as conditions on the neighbours. Functions that depend on the others to rounding
//! get the coefficient 0.

use faer::{
    Conj, Mat, MatRef, Par,
    dyn_stack::{MemBuffer, MemStack},
    linalg::{householder, solvers::ColPivQr, triangular_solve::solve_upper_triangular_in_place},
};

/// Pivots below this part of the first count as zero; columns have length 1 before.
const DEPENDENT: f64 = 1e-15;

/// Rows that touch the same cells: their blocks of columns side by side, the right-hand sides last.
struct Rows {
    cells: Vec<usize>,
    matrix: Mat<f64>,
}

/// min Σ |Σ_c A_c X_c − B|² over the blocks X_c.
pub(super) struct LeastSquares {
    sizes: Vec<usize>,
    right_sides: usize,
    rows: Vec<Rows>,
}

/// Block row R x_cell = right − Σ rest · x_neighbours, for the unknowns in the order of the pivots.
struct Eliminated {
    cell: usize,
    neighbours: Vec<usize>,
    triangle: Triangle,
}

/// Q R Pᵀ = A of rank r, and Qᵀ applied to what stood beside A.
struct Triangle {
    /// r × columns.
    upper: Mat<f64>,
    /// Column of A that column j of R stands for.
    order: Vec<usize>,
    beside: Mat<f64>,
}

impl Triangle {
    fn new(front: &Mat<f64>, mut beside: Mat<f64>) -> Self {
        let qr: ColPivQr<f64> = front.col_piv_qr();
        let r = qr.thin_R();
        let first = if r.nrows() > 0 && r.ncols() > 0 { r[(0, 0)].abs() } else { 0.0 };
        let rank = (0..r.nrows()).take_while(|&i| r[(i, i)].abs() > DEPENDENT * first).count();
        let block = qr.Q_coeff().nrows();
        let need = householder::apply_block_householder_sequence_transpose_on_the_left_in_place_scratch::<f64>(
            front.nrows(),
            block,
            beside.ncols(),
        );
        householder::apply_block_householder_sequence_transpose_on_the_left_in_place_with_conj(
            qr.Q_basis(),
            qr.Q_coeff(),
            Conj::No,
            beside.as_mut(),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(need)),
        );
        Self { upper: r.get(..rank, ..).to_owned(), order: qr.P().arrays().0.to_vec(), beside }
    }

    fn rank(&self) -> usize {
        self.upper.nrows()
    }
}

impl LeastSquares {
    /// A system without rows; `sizes` are the numbers of unknowns of the cells.
    pub(super) fn new(sizes: Vec<usize>, right_sides: usize) -> Self {
        Self { sizes, right_sides, rows: Vec::new() }
    }

    /// Adds `count` rows that touch the given cells; `fill(row, values)` writes a row: blocks in order, then the
    /// right-hand sides.
    pub(super) fn add_rows(
        &mut self,
        cells: &[usize],
        count: usize,
        mut fill: impl FnMut(usize, &mut [f64]),
    ) {
        let columns = self.width(cells) + self.right_sides;
        let mut values = vec![0.0; count * columns];
        for (i, row) in values.chunks_exact_mut(columns).enumerate() {
            fill(i, row);
        }
        let matrix = MatRef::from_row_major_slice(&values, count, columns).to_owned();
        self.rows.push(Rows { cells: cells.to_vec(), matrix });
    }

    /// Multiplications of the solution, roughly: rows by the square of columns.
    pub(super) fn cost(&self) -> f64 {
        self.rows.iter().map(|r| r.matrix.nrows() as f64 * (r.matrix.ncols() as f64).powi(2)).sum()
    }

    /// The unknowns of every cell, row-major: one row an unknown, one column a right-hand side.
    pub(super) fn solve(mut self) -> Vec<Vec<f64>> {
        let scales = self.equilibrate();
        let mut done = Vec::with_capacity(self.sizes.len());
        let mut open: Vec<usize> = (0..self.sizes.len()).collect();
        while let Some(cell) = self.next_cell(&mut open) {
            done.push(self.eliminate(cell));
        }
        let mut unknowns: Vec<Mat<f64>> =
            self.sizes.iter().map(|&s| Mat::zeros(s, self.right_sides)).collect();
        for step in done.iter().rev() {
            unknowns[step.cell] = self.substitute(step, &unknowns);
        }
        unknowns.iter().zip(&scales).map(|(x, scale)| row_major(x, scale)).collect()
    }

    fn width(&self, cells: &[usize]) -> usize {
        cells.iter().map(|&c| self.sizes[c]).sum()
    }

    /// Divides every column by its length; the lengths' inverses.
    fn equilibrate(&mut self) -> Vec<Vec<f64>> {
        let mut scales: Vec<Vec<f64>> = self.sizes.iter().map(|&s| vec![0.0; s]).collect();
        for rows in &self.rows {
            let mut column = 0;
            for &c in &rows.cells {
                for scale in &mut scales[c] {
                    *scale += rows.matrix.col(column).squared_norm_l2();
                    column += 1;
                }
            }
        }
        for scale in scales.iter_mut().flatten() {
            *scale = if *scale > 0.0 { scale.sqrt().recip() } else { 1.0 };
        }
        for rows in &mut self.rows {
            let mut column = 0;
            for &c in &rows.cells {
                for &scale in &scales[c] {
                    rows.matrix.col_mut(column).iter_mut().for_each(|x| *x *= scale);
                    column += 1;
                }
            }
        }
        scales
    }

    /// Takes the open cell with the fewest neighbours.
    fn next_cell(&self, open: &mut Vec<usize>) -> Option<usize> {
        let place = (0..open.len()).min_by_key(|&i| self.neighbours(open[i]).len())?;
        Some(open.remove(place))
    }

    fn neighbours(&self, cell: usize) -> Vec<usize> {
        let touching = self.rows.iter().filter(|r| r.cells.contains(&cell));
        let mut all: Vec<usize> =
            touching.flat_map(|r| r.cells.iter().copied()).filter(|&c| c != cell).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    fn eliminate(&mut self, cell: usize) -> Eliminated {
        let neighbours = self.neighbours(cell);
        let (touching, rest): (Vec<_>, Vec<_>) = self.rows.drain(..).partition(|r| r.cells.contains(&cell));
        self.rows = rest;
        let height: usize = touching.iter().map(|r| r.matrix.nrows()).sum();
        let mut front = Mat::zeros(height, self.sizes[cell]);
        let mut beside = Mat::zeros(height, self.width(&neighbours) + self.right_sides);
        let mut top = 0;
        for rows in &touching {
            let (count, mut from) = (rows.matrix.nrows(), 0);
            for c in rows.cells.iter().copied().map(Some).chain([None]) {
                let to = if c == Some(cell) { front.as_mut() } else { beside.as_mut() };
                let (first, width) =
                    if c == Some(cell) { (0, self.sizes[cell]) } else { self.place(&neighbours, c) };
                to.submatrix_mut(top, first, count, width)
                    .copy_from(rows.matrix.as_ref().subcols(from, width));
                from += width;
            }
            top += count;
        }
        let triangle = Triangle::new(&front, beside);
        if !neighbours.is_empty() {
            let left = triangle.beside.get(triangle.rank().., ..).to_owned();
            let matrix = self.compress(&neighbours, left);
            self.rows.push(Rows { cells: neighbours.clone(), matrix });
        }
        Eliminated { cell, neighbours, triangle }
    }

    /// Rows with the same squares of residuals, up to a constant, and no more of them than unknowns.
    fn compress(&self, cells: &[usize], matrix: Mat<f64>) -> Mat<f64> {
        let width = self.width(cells);
        if matrix.nrows() <= width {
            return matrix;
        }
        let (front, beside) = (matrix.get(.., ..width).to_owned(), matrix.get(.., width..).to_owned());
        let triangle = Triangle::new(&front, beside);
        let mut out = Mat::zeros(triangle.rank(), matrix.ncols());
        for (j, &column) in triangle.order.iter().enumerate() {
            for i in 0..triangle.rank().min(j + 1) {
                out[(i, column)] = triangle.upper[(i, j)];
            }
        }
        let rank = triangle.rank();
        out.get_mut(.., width..).copy_from(triangle.beside.get(..rank, ..));
        out
    }

    /// First column and number of columns of a neighbour, or of the right-hand sides.
    fn place(&self, neighbours: &[usize], wanted: Option<usize>) -> (usize, usize) {
        match wanted {
            Some(c) => {
                (neighbours.iter().take_while(|&&x| x != c).map(|&x| self.sizes[x]).sum(), self.sizes[c])
            }
            None => (self.width(neighbours), self.right_sides),
        }
    }

    fn substitute(&self, step: &Eliminated, unknowns: &[Mat<f64>]) -> Mat<f64> {
        let Triangle { upper, order, beside } = &step.triangle;
        let rank = upper.nrows();
        let part = |c: Option<usize>| {
            let (first, count) = self.place(&step.neighbours, c);
            beside.as_ref().submatrix(0, first, rank, count)
        };
        let mut y = part(None).to_owned();
        for &c in &step.neighbours {
            y -= part(Some(c)) * &unknowns[c];
        }
        solve_upper_triangular_in_place(upper.as_ref().submatrix(0, 0, rank, rank), y.as_mut(), Par::Seq);
        let mut x = Mat::zeros(order.len(), self.right_sides);
        for (i, &row) in order.iter().take(rank).enumerate() {
            for j in 0..self.right_sides {
                x[(row, j)] = y[(i, j)];
            }
        }
        x
    }
}

/// The transpose of the pseudo-inverse of a matrix of three columns and full rank: V (VᵀV)⁻¹.
pub(super) fn dual(rows: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let v = Mat::from_fn(rows.len(), 3, |i, j| rows[i][j]);
    let qr = v.qr();
    let q = qr.compute_thin_Q();
    // V = QR, so V (VᵀV)⁻¹ = Q R⁻ᵀ: every row of it solves R w = q.
    let mut w = Mat::from_fn(3, rows.len(), |i, j| q[(j, i)]);
    solve_upper_triangular_in_place(qr.thin_R(), w.as_mut(), Par::Seq);
    (0..rows.len()).map(|j| [w[(0, j)], w[(1, j)], w[(2, j)]]).collect()
}

fn row_major(x: &Mat<f64>, scale: &[f64]) -> Vec<f64> {
    (0..x.nrows())
        .flat_map(|i| (0..x.ncols()).map(move |j| (i, j)))
        .map(|(i, j)| x[(i, j)] * scale[i])
        .collect()
}
