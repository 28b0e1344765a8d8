import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import i18next from 'i18next';
import * as looking from '@/store/moment/looking';
import type { LogLine } from '@/store/session/types';
import { useProjectStore } from '@/store/project';
import { treeNode } from '../../../harness/running';
import { openProject, show, user, watchNavigation } from '../../../harness/testing';
import { ConsoleLine } from './ConsoleLine';

const t = i18next.getFixedT(null, 'console');

const line = (more: Partial<LogLine> = {}): LogLine => ({
  id: 1,
  source: 'action',
  level: 'warning',
  text: 'see Go.py:3',
  node_id: 'n1',
  node_path: 'Main/drive/Forward::6',
  time: 12.345,
  launch_node: '',
  ...more,
});

const showLine = (more: Partial<LogLine> = {}, node?: ReturnType<typeof treeNode>, launched?: string) =>
  show(
    <ConsoleLine
      line={line(more)}
      files={new Set(['actions/Go.py'])}
      node={node}
      launched={launched}
      isRecorded={false}
      t={t}
    />,
  );
const row = () => document.querySelector('[data-level]') as HTMLElement;

it('goes to the moment of a line that was recorded', async () => {
  const look = vi.spyOn(looking, 'lookAt').mockReturnValue(undefined);
  show(
    <ConsoleLine line={line()} files={new Set()} node={undefined} launched={undefined} isRecorded t={t} />,
  );
  await user.click(screen.getByRole('button', { name: '12.35' }));
  expect(look).toHaveBeenCalledWith(12.345);
});

describe('ConsoleLine', () => {
  it('shows time, level, source and text', () => {
    showLine();
    expect(row()).toHaveTextContent('12.35Forwardsee Go.py:3');
    expect([row().dataset['level'], row().dataset['source']]).toEqual(['warning', 'action']);
    expect(screen.getByTitle('Main/drive/Forward::6')).toHaveTextContent('Forward');
  });

  it('opens the block that printed it', async () => {
    openProject({ trees: { Main: { n1: { type: 'AlwaysSuccess' } } } });
    const { openTree } = watchNavigation();
    showLine({}, treeNode(1, 0, 'Forward::6'));
    const block = screen.getByRole('button', { name: 'Forward' });
    expect(block).toHaveAttribute('title', 'Show the block Main/drive/Forward::6');
    await user.click(block);
    expect(openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState().selection).toEqual(['n1']);
  });

  it('opens nothing for a node without a block', () => {
    showLine({}, treeNode(1, 0, 'Forward::6', { node_id: '' }));
    expect(screen.queryByRole('button', { name: 'Forward' })).toBeNull();
  });

  it('names the launch node, or the source', () => {
    const { unmount } = showLine({ node_path: '', source: 'launch' }, undefined, 'mapper');
    expect(screen.getByTitle('mapper')).toBeInTheDocument();
    unmount();
    showLine({ node_path: '', source: 'manager' });
    expect(screen.getByTitle('manager')).toBeInTheDocument();
  });

  it('opens the line that it mentions', async () => {
    const { openFile } = watchNavigation();
    showLine();
    await user.click(screen.getByRole('button', { name: 'Go.py:3' }));
    expect(openFile).toHaveBeenCalledWith('actions/Go.py', 3);
  });

  it('has the styles of a terminal', () => {
    showLine({ text: 'a\u001b[1;31mb' });
    const spans = [...document.querySelectorAll('span[data-ansi]')];
    expect(spans.map((span) => [span.textContent, span.getAttribute('data-ansi')])).toEqual([
      ['b', 'bold red'],
    ]);
  });

  it('separates two runs', () => {
    showLine({ run: 2 });
    expect(screen.getByRole('separator', { name: 'Run 2' })).toBeInTheDocument();
  });
});
