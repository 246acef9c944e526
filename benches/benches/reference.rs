//! How many blocks a second the reference model executes.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use gaugeblock_benches::workloads;
use gaugeblock_vocabulary::End;

fn executed_blocks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("reference");
    for workload in workloads() {
        let (outcome, _) = gaugeblock_reference::run(&workload.scenario);
        assert_eq!(outcome.end, End::ProgramEnd, "{} runs to its end", workload.name);
        let blocks = u64::try_from(outcome.steps.len()).expect("a count of blocks");
        group.throughput(Throughput::Elements(blocks));
        group.bench_function(workload.name, |bencher| {
            bencher.iter(|| gaugeblock_reference::run(&workload.scenario));
        });
    }
    group.finish();
}

criterion_group!(benches, executed_blocks);
criterion_main!(benches);
