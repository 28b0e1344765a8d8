import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject } from '../../../harness/testing';
import { lintSoon, watchPython } from './lint';
import { useTextFindings } from './texts';

const LINT = 'POST /python/lint';
const PATH = 'nodes/tones.py';
const store = () => useProjectStore.getState();
const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);
const linted = () => useTextFindings.getState().linted[PATH];

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  openProject({ texts: { [PATH]: 'a', 'notes.md': 'b' } });
  const end = watchPython();
  onTestFinished(() => {
    end();
    vi.useRealTimers();
  });
});

describe('ruff', () => {
  it('is requested for a Python file shortly after its last change', async () => {
    const { requests } = fakeServer({ [LINT]: { findings: [{}, {}] } });
    store().setFileText(PATH, 'a =');
    await pass(500);
    store().setFileText(PATH, 'a = =');
    await pass(699);
    expect(requests).toEqual([]);
    await pass(1);
    expect(requests.map(({ body }) => body)).toEqual([{ source: 'a = =', filename: PATH }]);
    expect(linted()).toEqual({ text: 'a = =', findings: [{}, {}] });
  });

  it('is requested for a file that opens, once for each text', async () => {
    const { requests } = fakeServer({ [LINT]: { findings: [] } });
    for (let opened = 0; opened < 2; opened += 1) {
      lintSoon(PATH);
      await pass(700);
    }
    lintSoon('notes.md');
    store().setFileText('notes.md', 'c');
    await pass(2000);
    expect(requests).toHaveLength(1);
  });

  it('keeps earlier findings if there is no answer', async () => {
    const answers: Record<string, unknown> = { [LINT]: { findings: [{}] } };
    fakeServer(answers);
    lintSoon(PATH);
    await pass(700);
    delete answers[LINT];
    store().setFileText(PATH, 'b');
    await pass(700);
    expect(linted()).toMatchObject({ text: 'a' });
  });

  it('is forgotten with the file', async () => {
    fakeServer({ [LINT]: { findings: [{}] } });
    lintSoon(PATH);
    await pass(700);
    store().deleteFile(PATH);
    expect(linted()).toBeUndefined();
  });
});
