import { readFileSync } from 'node:fs';
import catalog from '@catalog';
import { describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { readCatalog } from '../vocabulary';
import { explain, RULES, verdicts } from './explain';
import type { TickFacts } from './facts';

type Row = readonly [uid: number, parent: number, type: string, kind: string, conditions: readonly string[]];

interface Ran {
  readonly what: string;
  readonly nodes: readonly Row[];
  readonly ticks: readonly {
    readonly changed: string;
    readonly flashed: string;
    readonly ticked: string;
    readonly halt?: true;
  }[];
}

const LETTERS: Record<string, NodeStatus> = {
  I: 'IDLE',
  R: 'RUNNING',
  S: 'SUCCESS',
  F: 'FAILURE',
  K: 'SKIPPED',
};
const cases = JSON.parse(readFileSync('../tests/shared/ticks.json', 'utf-8')) as readonly Ran[];

const marks = (text: string): [number, NodeStatus][] =>
  [...text.matchAll(/(\d+)([IRSFK])/g)].map(([, uid, letter]) => [
    Number(uid),
    LETTERS[letter ?? ''] ?? 'IDLE',
  ]);

interface Tick {
  readonly where: string;
  readonly facts: TickFacts;
  /** The results of each node, in order, as the engine logged them. */
  readonly truth: ReadonlyMap<number, readonly NodeStatus[]>;
}

/** Returns all ticks of a run; `knows` says whether the pre-conditions are known. */
function ticksOf({ what, nodes, ticks }: Ran, knows: boolean): Tick[] {
  const status = new Map<number, NodeStatus>();
  const found: Tick[] = [];
  const conditions = new Map(nodes.map(([uid, , , , names]) => [uid, names]));
  ticks.forEach(({ changed, flashed, ticked, halt }, at) => {
    const before = new Map(status);
    marks(changed).forEach(([uid, now]) => status.set(uid, now));
    if (halt) return;
    const truth = new Map<number, NodeStatus[]>();
    for (const [uid, result] of marks(ticked)) truth.set(uid, [...(truth.get(uid) ?? []), result]);
    found.push({
      where: `${what}, tick ${at}`,
      facts: {
        nodes: nodes.map(([uid, parent, type, kind]) => ({ uid, parent, type, kind })),
        ...{ before, changed: marks(changed), flashed: marks(flashed) },
        conditions: (uid) => (knows ? (conditions.get(uid) ?? []) : null),
      },
      truth,
    });
  });
  return found;
}

describe.each([true, false])('words about random runs; pre-conditions known: %s', (knows) => {
  const ticks = cases.flatMap((each) => ticksOf(each, knows));

  it('never contradict the run', () => {
    const wrong: string[] = [];
    for (const { where, facts, truth } of ticks)
      for (const [uid, { ticked, result, reason }] of verdicts(facts)) {
        const results = truth.get(uid);
        const name = `${where}, ${facts.nodes[uid - 1]?.type} ${uid} (${reason.code})`;
        if (ticked === 'yes' && !results) wrong.push(`${name}: it was not ticked`);
        if (ticked === 'no' && results) wrong.push(`${name}: it was ticked: ${results.join()}`);
        if (ticked === 'yes' && result !== null && results && !results.includes(result))
          wrong.push(`${name}: ${result}, but it returned ${results.join()}`);
      }
    expect(wrong.length, wrong.slice(0, 30).join('\n')).toBe(0);
  });

  it('name results that their nodes returned, or returned before', () => {
    const wrong: string[] = [];
    for (const { where, facts, truth } of ticks)
      for (const [uid, { reason }] of verdicts(facts)) {
        const { code, by, status } = reason;
        if (by === undefined || status === undefined) continue;
        const isEarlier = ['done', 'afterEarlier', 'chosenEarlier', 'notChosenEarlier'].includes(code);
        const named = isEarlier ? facts.before.get(by) : truth.get(by)?.at(-1);
        if (named !== status) wrong.push(`${where}, ${uid} (${code}): ${by} ${status}, not ${named}`);
      }
    expect(wrong.length, wrong.slice(0, 30).join('\n')).toBe(0);
  });

  it('seldom have to say that something was not recorded', () => {
    let all = 0;
    const open = new Map<string, number>();
    for (const { facts } of ticks)
      for (const [uid, { ticked, reason }] of verdicts(facts)) {
        all += 1;
        const parent = facts.nodes[(facts.nodes[uid - 1]?.parent ?? 0) - 1]?.type ?? '';
        if (ticked !== 'yes' && (ticked === 'unknown' || reason.code === 'notRecorded'))
          open.set(`${parent} ${reason.code}`, (open.get(`${parent} ${reason.code}`) ?? 0) + 1);
      }
    const sum = [...open.values()].reduce((a, b) => a + b, 0);
    expect(sum / all).toBeLessThan(knows ? 0.05 : 0.1);
  });
});

describe('the path to a node', () => {
  const nodes = [
    { uid: 1, parent: 0, type: 'Fallback', kind: 'Control' },
    { uid: 2, parent: 1, type: 'Sequence', kind: 'Control' },
    { uid: 3, parent: 2, type: 'IsFree', kind: 'Condition' },
    { uid: 4, parent: 2, type: 'Forward', kind: 'Action' },
    { uid: 5, parent: 1, type: 'Turn', kind: 'Action' },
  ];
  const facts: TickFacts = {
    nodes,
    before: new Map(),
    changed: [
      [1, 'RUNNING'],
      [5, 'RUNNING'],
    ],
    flashed: [
      [3, 'FAILURE'],
      [2, 'FAILURE'],
    ],
    conditions: () => null,
  };

  it('has the reason at each parent, and the child from which the node has its result', () => {
    expect(explain(facts, 2)).toEqual({
      steps: [
        { uid: 1, parent: 0, verdict: { ticked: 'yes', result: 'RUNNING', reason: { code: 'root' } } },
        { uid: 2, parent: 1, verdict: { ticked: 'yes', result: 'FAILURE', reason: { code: 'first' } } },
      ],
      outcome: { code: 'after', by: 3, status: 'FAILURE' },
    });
    expect(explain(facts, 5)?.steps.at(-1)?.verdict.reason).toEqual({
      code: 'after',
      by: 2,
      status: 'FAILURE',
    });
  });

  it('says why a node was not ticked, and ends at the first that was not', () => {
    expect(explain(facts, 4)?.steps.at(-1)).toMatchObject({
      uid: 4,
      verdict: { ticked: 'no', reason: { code: 'ended', by: 3, status: 'FAILURE' } },
    });
    const still = { ...facts, before: new Map([[1, 'RUNNING'] as const, [5, 'RUNNING'] as const]) };
    const steps = explain({ ...still, changed: [], flashed: [] }, 4)?.steps;
    expect(steps?.map(({ uid }) => uid)).toEqual([1, 2]);
    expect(steps?.at(-1)?.verdict).toMatchObject({ ticked: 'no', reason: { code: 'passed' } });
  });

  it('says that a result was forced, and does not explain the nodes below by a rule', () => {
    const of = (uid: number, more: Partial<TickFacts>) => explain({ ...facts, ...more }, uid);
    const forced = { forced: new Set([2]), flashed: [[2, 'FAILURE'] as const] };
    expect(of(2, forced)?.outcome).toEqual({ code: 'forced', status: 'FAILURE' });
    expect(of(3, forced)?.steps.at(-1)?.verdict).toMatchObject({
      ticked: 'no',
      reason: { code: 'parentForced', status: 'FAILURE' },
    });
    // The result was replaced after the tick: what its children returned stays true.
    const after = { ...forced, flashed: [[3, 'SUCCESS'] as const, ...forced.flashed] };
    expect(of(3, after)?.steps.at(-1)?.verdict).toMatchObject({ ticked: 'yes', result: 'SUCCESS' });
    // A frozen node changes nothing, and is ticked all the same.
    const before = new Map([[1, 'RUNNING'] as const, [5, 'RUNNING'] as const]);
    const frozen = of(5, { before, changed: [], flashed: [], forced: new Set([5]) });
    expect(frozen?.steps.at(-1)?.verdict).toMatchObject({ ticked: 'yes', result: 'RUNNING' });
    expect(frozen?.outcome).toMatchObject({ code: 'forced', status: 'RUNNING' });
  });

  it('is null for a node of another tree', () => {
    expect(explain(facts, 99)).toBeNull();
  });
});

it('there is a rule for each built-in node with children', () => {
  const types = readCatalog(catalog).filter(({ family }) =>
    ['control', 'decorator', 'subtree'].includes(family),
  );
  expect(types.length).toBeGreaterThan(30);
  expect(types.map(({ type }) => type).filter((type) => !(type in RULES))).toEqual([]);
});
