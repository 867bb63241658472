//! Chunks of a batch, on all threads where there are many.

/// Points that a thread takes at a time; a batch of no more stays on the caller's thread.
pub(super) const CHUNK: usize = 8192;

/// Calls `job` for each chunk of parameters with the chunks of the buffers that belong to it.
///
/// No result depends on the number of threads, since none depends on a point's place.
pub(super) fn each_chunk<'a, I, const K: usize>(
    parameters: I,
    mut out: [std::slice::ChunksMut<'a, f64>; K],
    job: impl Fn(I::Item, [&'a mut [f64]; K]) + Send + Sync,
) where
    I: ExactSizeIterator + Send,
    I::Item: Send,
{
    let mut next =
        move || -> [&'a mut [f64]; K] { std::array::from_fn(|k| out[k].next().unwrap_or_default()) };
    #[cfg(feature = "rayon")]
    if parameters.len() > 1 && rayon::current_num_threads() > 1 {
        let job = &job;
        rayon::scope(|scope| {
            for parameters in parameters {
                let out = next();
                scope.spawn(move |_| job(parameters, out));
            }
        });
        return;
    }
    for parameters in parameters {
        job(parameters, next());
    }
}
