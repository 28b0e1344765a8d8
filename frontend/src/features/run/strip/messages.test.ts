import { describe, expect, it } from 'vitest';
import type { Diagnostic } from '@/api/types';
import type { Fault } from '@/generated/messages';
import { openProject } from '../../../../harness/testing';
import { messagesFor, PRIORITY, type Situation } from './messages';

const bannerFor = (situation: Situation) => messagesFor(situation)[0] ?? null;

const calm = {
  connection: 'open',
  connectionMessage: '',
  silentS: 0,
  executorReason: '',
  faults: [],
  failure: null,
  finished: null,
  launchNodes: [],
  viewer: null,
  canRestart: false,
  worldRuns: false,
} as const;

const fault = (more: Partial<Fault>): Fault => ({
  kind: 'exception',
  message: 'boom',
  hint: '',
  node_id: '',
  tree_id: '',
  node_path: '',
  file: '',
  line: 0,
  traceback: '',
  ...more,
});

describe('bannerFor', () => {
  it('has no message if nothing happened', () => {
    expect(bannerFor(calm)).toBeNull();
  });

  it('offers the list of own robots where too many of them wait', () => {
    const failure = {
      stage: 'starting',
      message: '2 robots of yours wait.',
      hint: '',
      diagnostics: [],
    } as const;
    const shown = (code: string) =>
      bannerFor({ ...calm, failure: { ...failure, code, diagnostics: [] } })?.command;
    expect(shown('own_places_taken')).toBe('run.mine');
    expect(shown('host_full')).toBeUndefined();
  });

  it('says what an error prevented: a start, or a change to the running tree', () => {
    const failure = { code: 'check_failed', message: 'bad', hint: '', diagnostics: [] };
    const title = (what: { stage: 'checking' | 'applying'; isChange?: true }) =>
      bannerFor({ ...calm, failure: { ...failure, ...what } })?.titleKey;
    expect(title({ stage: 'checking' })).toBe('banner.failed.checking');
    expect(title({ stage: 'checking', isChange: true })).toBe('banner.unchanged.checking');
    expect(title({ stage: 'applying', isChange: true })).toBe('banner.unchanged.applying');
  });

  it('names the block that failed, and links to it', () => {
    const finished = {
      status: 'FAILURE',
      reason: 'root_finished',
      message: 'The tree ended with FAILURE. Go is not written yet.',
      node_id: 'n3',
      tree_id: 'MainTree',
      node_path: 'try/AlwaysFailure::3',
    } as const;
    expect(bannerFor({ ...calm, executorReason: finished.message, finished })).toMatchObject({
      titleKey: 'banner.finished.FAILURE',
      values: { node: 'AlwaysFailure' },
      text: 'Go is not written yet.',
      link: { tree: 'MainTree', node: 'n3' },
    });
    const succeeded = { ...finished, status: 'SUCCESS' } as const;
    expect(bannerFor({ ...calm, executorReason: 'ended', finished: succeeded })).toMatchObject({
      tone: 'success',
      link: null,
    });
  });

  it('links to the line that raised', () => {
    const banner = bannerFor({
      ...calm,
      faults: [fault({ file: 'actions/Go.py', line: 12, node_id: 'n1' })],
    });
    expect(banner).toMatchObject({ titleKey: 'banner.faultAt', link: { file: 'actions/Go.py', line: 12 } });
  });

  it('links to the block if there is no line', () => {
    const faults = [fault({ kind: 'timeout', node_id: 'n1', tree_id: 'MainTree' })];
    expect(bannerFor({ ...calm, faults })?.link).toEqual({ tree: 'MainTree', node: 'n1' });
  });

  it('names the block that hangs', () => {
    const faults = [fault({ kind: 'timeout', node_path: 'bump and go/Forward::6' })];
    expect(bannerFor({ ...calm, faults })).toMatchObject({
      titleKey: 'banner.faultOf.timeout',
      values: { node: 'Forward' },
    });
  });

  it('reports why the world ended', () => {
    expect(bannerFor({ ...calm, executorReason: 'The simulated world was killed.' })?.text).toMatch(/world/);
  });

  it('reports silence as a warning, before earlier faults', () => {
    const banner = bannerFor({ ...calm, silentS: 4, faults: [fault({})] });
    expect(banner).toMatchObject({
      kind: 'silence',
      tone: 'warning',
      titleKey: 'banner.silent',
      values: { seconds: '4' },
    });
    expect(banner?.hint).toMatch(/Run starts a new one/);
    expect(bannerFor({ ...calm, silentS: 4, connection: 'lost' })?.kind).toBe('connection');
  });

  it('puts the lost connection first', () => {
    const banner = bannerFor({ ...calm, connection: 'reconnecting', faults: [fault({})] });
    expect(banner).toMatchObject({ kind: 'connection', tone: 'warning' });
  });

  it('names the first error of a project that cannot run', () => {
    const failure = {
      stage: 'checking' as const,
      code: 'invalid_project',
      message: 'The project has errors.',
      hint: '',
      diagnostics: [
        {
          code: 'BT0201',
          severity: 'error' as const,
          message: 'No such action.',
          tree: 'MainTree',
          node: 'n4',
        },
      ],
    };
    const banner = bannerFor({ ...calm, failure });
    expect(banner).toMatchObject({ text: 'No such action.', link: { tree: 'MainTree', node: 'n4' } });
  });

  it('has the words that the block has, and links to the field of the port, not to the JSON', () => {
    openProject({ trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } } });
    const item: Diagnostic = {
      code: 'BT0201',
      severity: 'error',
      message: 'Other words.',
      hint: 'Other.',
      ...{ tree: 'Main', node: 'a', port: 'msec', file: 'trees/Main.json', line: 1 },
    };
    const failure = { stage: 'checking', code: 'check_failed', message: '', hint: '' } as const;
    expect(bannerFor({ ...calm, failure: { ...failure, diagnostics: [item] } })).toMatchObject({
      text: 'The port “msec” needs a value.',
      hint: 'Type a whole number, 0 or more, or use a blackboard key: {key}.',
      link: { tree: 'Main', node: 'a', port: 'msec' },
    });
  });

  it('links to the line of a robot that the simulator refuses', () => {
    const message = "robots/mine/robot.yaml:10:25: the URDF has no link 'mst'";
    const failure = { stage: 'launching' as const, code: 'BTR003', message, hint: '', diagnostics: [] };
    expect(bannerFor({ ...calm, failure })?.link).toEqual({ file: 'robots/mine/robot.yaml', line: 10 });
    expect(bannerFor({ ...calm, failure: { ...failure, message: 'at 10:25: no' } })?.link).toBeNull();
  });
});

describe('messagesFor', () => {
  it('lists all messages by their importance', () => {
    const all = messagesFor({
      ...calm,
      connection: 'reconnecting',
      faults: [fault({ message: 'boom' }), fault({ message: 'bang' }), fault({ message: 'boom' })],
      viewer: { wasTakenOver: false },
      canRestart: true,
      worldRuns: true,
    });
    expect(all.map(({ kind }) => kind)).toEqual([
      'connection',
      'fault',
      'fault',
      'viewer',
      'restart',
      'world',
    ]);
    expect(new Set(PRIORITY).size).toBe(PRIORITY.length);
    expect(new Set(all.map(({ id }) => id)).size).toBe(all.length);
  });

  it('puts the offer of a restart before a failed launch node, which does not end the run', () => {
    const node = fault({ kind: 'process', file: 'launch/a.yaml', line: 2 });
    const at = { file: 'launch/a.yaml', line: 2, id: 'a', name: 'a', package: '', executable: '' };
    const launchNodes = [{ ...at, state: 'failed', restarts: 0, end: '' }] as const;
    const all = messagesFor({ ...calm, faults: [node], launchNodes, canRestart: true });
    expect(all.map(({ kind }) => kind)).toEqual(['restart', 'node']);
  });

  it('does not repeat the end of a run that a fault explains', () => {
    const faults = [fault({})];
    expect(messagesFor({ ...calm, faults, executorReason: 'It ended.' })).toHaveLength(1);
  });
});
