import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Diagnostic } from '@/api/types';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { forgetEditor } from '../../../harness/canvas';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { NodeProblems } from './NodeProblems';

const onFixed = vi.fn();

function Problems({ id }: { readonly id: string }) {
  const diagram = useProjectStore((state) => state.diagrams['Main']);
  return diagram ? <NodeProblems diagram={diagram} id={id} onFixed={onFixed} /> : null;
}

const finding = (severity: Diagnostic['severity'], message: string, node: string): Diagnostic => ({
  code: message,
  severity,
  message,
  hint: `Hint of ${message}`,
  tree: 'Main',
  node,
});
const items = () =>
  screen.queryAllByRole('listitem').map((item) => [item.dataset['severity'], item.textContent]);

beforeEach(() => {
  onFixed.mockReset();
  forgetEditor();
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 'b', 'g'] },
        a: { type: 'Sleep', ports: { msec: '{' } },
        b: { type: 'AlwaysSuccess' },
        g: { type: 'AlwaysSuccess' },
      },
    },
    diagnostics: [
      finding('note', 'One.', 'b'),
      finding('error', 'Two.', 'b'),
      finding('error', 'Other.', 'r'),
    ],
  });
});

describe('NodeProblems', () => {
  it('is absent for a block without problems', () => {
    show(<Problems id="g" />);
    expect(screen.queryByRole('list')).toBeNull();
  });

  it('has the problems of the block and no other, each with its hint and sign', () => {
    show(<Problems id="b" />);
    expect(items()).toEqual([
      ['note', 'One. Hint of One.'],
      ['error', 'Two. Hint of Two.'],
    ]);
    const signs = [...document.querySelectorAll('li > svg')].map((svg) => svg.getAttribute('class'));
    expect(signs[0]).toContain('info-circle');
    expect(signs[1]).toContain('alert-triangle');
  });

  it('fixes the block', async () => {
    show(<Problems id="a" />);
    await user.click(screen.getAllByRole('button', { name: /^Use the key/ })[0]!);
    expect(nodeOf('Main', 'a')?.ports).toEqual({ msec: '{msec}' });
    expect(onFixed).toHaveBeenCalledOnce();
    expect(screen.queryByRole('list')).toBeNull();
  });

  it('has the fault of the last run first', () => {
    show(<Problems id="b" />);
    act(() => useLiveStore.setState({ faults: new Map([['Main/b', 'boom']]) }));
    expect(screen.getAllByRole('listitem')[0]).toHaveTextContent('An action failed: boom');
    expect(items()).toHaveLength(3);
  });

  it('has the fault of a block without problems', () => {
    show(<Problems id="g" />);
    act(() => useLiveStore.setState({ faults: new Map([['Dock/g', 'boom']]) }));
    expect(screen.queryByRole('list')).toBeNull();
    act(() => useLiveStore.setState({ faults: new Map([['Main/g', 'boom']]) }));
    expect(items()).toHaveLength(1);
  });
});
