import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { fakeServer, show } from '../../../harness/testing';
import { useFindings } from './useFindings';

const LINT = 'POST /python/lint';

function Found({ path, text }: { readonly path: string; readonly text: string | null }) {
  const linted = useFindings(path, text);
  return <p>{linted ? `${linted.findings.length} in ${linted.doc.lines} lines` : 'not asked'}</p>;
}

const pass = (ms: number) => act(() => vi.advanceTimersByTimeAsync(ms));

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  onTestFinished(() => {
    vi.useRealTimers();
  });
});

describe('useFindings', () => {
  it('asks ruff a moment after the last change', async () => {
    const { requests } = fakeServer({ [LINT]: { findings: [{}, {}] } });
    const { rerender } = show(<Found path="actions/Go.py" text="a" />);
    await pass(500);
    rerender(<Found path="actions/Go.py" text={'a\nb'} />);
    await pass(699);
    expect(requests).toEqual([]);
    await pass(1);
    expect(requests.map(({ body }) => body)).toEqual([{ source: 'a\nb', filename: 'actions/Go.py' }]);
    expect(screen.getByText('2 in 2 lines')).toBeInTheDocument();
  });

  it('keeps what it knows where there is no answer', async () => {
    const answers: Record<string, unknown> = { [LINT]: { findings: [{}] } };
    fakeServer(answers);
    const { rerender } = show(<Found path="a.py" text="a" />);
    await pass(700);
    delete answers[LINT];
    rerender(<Found path="a.py" text="b" />);
    await pass(700);
    expect(screen.getByText('1 in 1 lines')).toBeInTheDocument();
  });

  it.each([
    ['a.md', 'text'],
    ['a.py', null],
  ])('does not ask about %s with %s', async (path, text) => {
    const { requests } = fakeServer({});
    show(<Found path={path} text={text} />);
    await pass(2000);
    expect(requests).toEqual([]);
  });
});
