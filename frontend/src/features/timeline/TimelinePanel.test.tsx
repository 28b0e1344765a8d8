import { act, createEvent, fireEvent, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import * as looking from '@/store/moment/looking';
import { useShownTrace } from '@/store/moment/shownTrace';
import { atPresent, useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { Trace } from '@/store/session/trace/trace';
import { runTree, treeNode } from '../../../harness/running';
import { openProject, show, user, watchNavigation } from '../../../harness/testing';
import { TimelinePanel } from './TimelinePanel';

const nodes = [
  treeNode(1, 0, 'root'),
  treeNode(2, 1, 'drive', { type: 'Forward' }),
  treeNode(3, 1, 'Turn::3', { type: 'Turn', node_id: '' }),
];

beforeEach(() => {
  // jsdom has no layout: the list of rows is 300 px high, the canvas 400 px wide, 100 px from the left.
  vi.spyOn(Element.prototype, 'clientHeight', 'get').mockReturnValue(300);
  vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(400);
  vi.spyOn(HTMLElement.prototype, 'offsetHeight', 'get').mockReturnValue(300);
  vi.spyOn(HTMLElement.prototype, 'offsetWidth', 'get').mockReturnValue(400);
  vi.spyOn(HTMLCanvasElement.prototype, 'getBoundingClientRect').mockReturnValue(
    new DOMRect(100, 0, 400, 300),
  );
});

const run = () => {
  openProject({
    trees: { Main: { n1: { type: 'Sequence', children: ['n2'] }, n2: { type: 'AlwaysSuccess' } } },
  });
  runTree(nodes, { 80: [[1, 'RUNNING']] }, 100);
  show(<TimelinePanel />);
};
const rows = () => screen.getByRole('group', { name: 'Nodes of the running tree' });
const names = () => [...rows().querySelectorAll('button')].map(({ textContent }) => textContent);
const tool = (name: RegExp | string) => screen.getByRole('button', { name });
const isFollowing = () => tool('Follow the run').getAttribute('aria-pressed');

/** Returns the time at a place of the canvas, as the tip shows it; `share` is the part of the width. */
function timeAt(share: number): string | undefined {
  fireEvent.pointerMove(rows(), { clientX: 100 + 400 * share, clientY: 5 });
  const time = /(?:idle at|from) (\S+)/.exec(screen.getByRole('presentation').textContent ?? '')?.[1];
  fireEvent.pointerLeave(rows());
  return time;
}

/** Returns the times at both ends of the canvas. The pointer is over a node that was always idle. */
function span(): (string | undefined)[] {
  const at = (share: number) => {
    fireEvent.pointerMove(rows(), { clientX: 100 + 400 * share, clientY: 30 });
    return /idle at (\S+)/.exec(screen.getByRole('presentation').textContent ?? '')?.[1];
  };
  const found = [at(0), at(1)];
  fireEvent.pointerLeave(rows());
  return found;
}

describe('rows', () => {
  it('explain before a run what they will show', () => {
    show(<TimelinePanel />);
    expect(screen.getByText(/appears here when you run/)).toBeInTheDocument();
    expect(names()).toEqual([]);
  });

  it('are the nodes of the running tree, or the matches of a search', async () => {
    run();
    expect(names()).toEqual(['root', 'drive', 'Turn']);
    expect(screen.queryByText(/appears here/)).toBeNull();
    const search = screen.getByRole('searchbox', { name: 'Search nodes' });
    await user.type(search, 'dri');
    expect(names()).toEqual(['drive']);
    await user.type(search, 'x');
    expect(names()).toEqual([]);
    expect(screen.getByText('No node has this name.')).toBeInTheDocument();
  });

  it('open the block of their node', async () => {
    run();
    const { openTree } = watchNavigation();
    await user.click(screen.getByRole('button', { name: /^drive/ }));
    expect(openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState().selection).toEqual(['n2']);
  });

  it('open nothing for a node without a block', async () => {
    run();
    const { openTree } = watchNavigation();
    await user.click(screen.getByRole('button', { name: /^Turn/ }));
    expect(openTree).not.toHaveBeenCalled();
  });
});

describe('keys', () => {
  it('walk the rows', async () => {
    run();
    const row = (name: RegExp) => screen.getByRole('button', { name });
    const press = async (key: string, name: RegExp) => {
      await user.keyboard(`{${key}}`);
      await waitFor(() => expect(row(name)).toHaveFocus());
      expect(row(name)).toHaveAttribute('tabindex', '0');
    };
    row(/^root/).focus();
    await press('ArrowDown', /^drive/);
    expect(row(/^root/)).toHaveAttribute('tabindex', '-1');
    await press('ArrowDown', /^Turn/);
    await press('ArrowDown', /^Turn/);
    await press('ArrowUp', /^drive/);
    await press('PageUp', /^root/);
    await press('PageDown', /^Turn/);
    await press('Home', /^root/);
    await press('End', /^Turn/);
  });

  it('move ten rows by page', async () => {
    const many = Array.from({ length: 30 }, (_, index) => treeNode(index + 1, 0, `node${index + 1}`));
    runTree(many, {}, 100);
    show(<TimelinePanel />);
    const row = (name: string) => rows().querySelector(`[aria-label^="${name},"]`);
    (row('node1') as HTMLElement).focus();
    await user.keyboard('{PageDown}');
    await waitFor(() => expect(row('node11')).toHaveFocus());
    await user.keyboard('{PageUp}');
    await waitFor(() => expect(row('node1')).toHaveFocus());
  });

  it.each([
    ['ArrowLeft', ['1:04', '1:34'], 'false'],
    ['ArrowRight', ['1:10', '1:40'], 'true'],
    ['0', ['0', '1:40'], 'true'],
    ['-', ['58', '1:40'], 'true'],
    ['+', ['1:18.6', '1:40'], 'true'],
  ])('%s moves or zooms the span', (key, expected, following) => {
    run();
    expect(fireEvent.keyDown(rows(), { key })).toBe(false);
    expect(span()).toEqual(expected);
    expect(isFollowing()).toBe(following);
  });

  it.each([{ key: 'ArrowLeft', ctrlKey: true }, { key: '-', metaKey: true }, { key: 'x' }])(
    'leaves other keys to the page',
    (press) => {
      run();
      expect(fireEvent.keyDown(rows(), press)).toBe(true);
      expect(span()).toEqual(['1:10', '1:40']);
    },
  );
});

describe('tools', () => {
  it('zoom in and out, show all, and follow', async () => {
    run();
    await user.click(tool('Zoom in (+)'));
    expect(span()).toEqual(['1:18.6', '1:40']);
    await user.click(tool(/^Zoom out/));
    expect(span()).toEqual(['1:10', '1:40']);
    fireEvent.keyDown(rows(), { key: 'ArrowLeft' });
    expect(isFollowing()).toBe('false');
    await user.click(tool('Follow the run'));
    expect([isFollowing(), span()]).toEqual(['true', ['1:10', '1:40']]);
    await user.click(tool(/^Show the whole run/));
    expect(span()).toEqual(['0', '1:40']);
  });
});

describe('the pointer', () => {
  it('shows the status of the node below it', () => {
    run();
    fireEvent.pointerMove(rows(), { clientX: 400, clientY: 5 });
    expect(screen.getByRole('presentation')).toHaveTextContent('root running from 1:20 for 20.00 s');
    expect(timeAt(0.2)).toBe('1:16');
    fireEvent.pointerMove(rows(), { clientX: 400, clientY: 500 });
    expect(screen.queryByRole('presentation')).toBeNull();
    fireEvent.pointerMove(rows(), { clientX: 400, clientY: 49 });
    expect(screen.getByRole('presentation')).toHaveTextContent('Turn idle at 1:32');
    fireEvent.pointerMove(rows(), { clientX: 50, clientY: 49 });
    expect(screen.queryByRole('presentation')).toBeNull();
  });

  /** Presses at a place, and moves the pointer by a number of pixels. */
  function drag(from: number, by: number, button = 0): void {
    onTestFinished(() => void fireEvent.pointerUp(window, { pointerId: 1 }));
    fireEvent.pointerDown(rows(), { clientX: from, clientY: 30, button, pointerId: 1 });
    const move = createEvent.pointerMove(rows(), { clientX: from + by, clientY: 30, pointerId: 1 });
    Object.defineProperty(move, 'movementX', { value: by });
    fireEvent(rows(), move);
  }

  it('drags the span', () => {
    run();
    drag(200, 40);
    expect(span()).toEqual(['1:07', '1:37']);
  });

  it('restores the span with Escape', () => {
    run();
    drag(200, 40);
    expect(isFollowing()).toBe('false');
    fireEvent.keyDown(rows(), { key: 'Escape' });
    expect(span()).toEqual(['1:10', '1:40']);
    expect(isFollowing()).toBe('true');
  });

  it('drags nothing by the few pixels of a click, or with another button', async () => {
    run();
    const { openTree } = watchNavigation();
    drag(200, 40, 2);
    drag(200, 4);
    expect(span()).toEqual(['1:10', '1:40']);
    fireEvent.click(screen.getByRole('button', { name: /^drive/ }));
    expect(openTree).toHaveBeenCalled();
  });

  it('selects no row at the end of a drag', () => {
    run();
    const { openTree } = watchNavigation();
    drag(200, 40);
    fireEvent.click(screen.getByRole('button', { name: /^drive/ }));
    expect(openTree).not.toHaveBeenCalled();
  });
});

describe('the wheel', () => {
  const turn = (init: WheelEventInit) => fireEvent.wheel(rows(), { clientX: 300, ...init });

  it('zooms about the pointer with Ctrl or Command', () => {
    run();
    // The range is half as long, and its middle stays.
    expect(turn({ deltaY: Math.log(0.5) / 0.002, ctrlKey: true })).toBe(false);
    expect(span()).toEqual(['1:17.5', '1:32.5']);
    turn({ deltaY: Math.log(0.5) / 0.002, metaKey: true });
    expect(span()).toEqual(['1:21.3', '1:28.8']);
  });

  it('zooms about the edge for a pointer beside the canvas', () => {
    run();
    turn({ deltaY: Math.log(0.5) / 0.002, ctrlKey: true, clientX: 10 });
    expect(span()).toEqual(['1:10', '1:25']);
  });

  it('pans sideways, and with Shift', () => {
    run();
    expect(turn({ deltaX: -40 })).toBe(false);
    expect(span()).toEqual(['1:07', '1:37']);
    turn({ deltaY: -40, shiftKey: true });
    expect(span()).toEqual(['1:04', '1:34']);
    turn({ deltaX: 40, shiftKey: true });
    expect(span()).toEqual(['1:07', '1:37']);
  });

  it('otherwise scrolls the rows', () => {
    run();
    expect(turn({ deltaY: 40 })).toBe(true);
    expect(span()).toEqual(['1:10', '1:40']);
  });
});

it('looks at the moment of a bar that is clicked, and of nothing else', () => {
  const look = vi.spyOn(looking, 'lookAt').mockReturnValue(undefined);
  run();
  fireEvent.click(rows(), { clientX: 480, clientY: 5, detail: 1 });
  expect(look).toHaveBeenCalledTimes(1);
  expect(look.mock.calls[0]![0]).toBeCloseTo(98.5, 0);
  fireEvent.click(rows(), { clientX: 480, clientY: 30, detail: 1 });
  fireEvent.click(rows(), { clientX: 480, clientY: 5, detail: 0 });
  expect(look).toHaveBeenCalledTimes(1);
});

it('goes to the changes of the row that has the focus, by comma and full stop', async () => {
  const go = vi.spyOn(looking, 'goToChange').mockResolvedValue(true);
  run();
  rows().querySelector('button')!.focus();
  await user.keyboard('{ArrowDown}');
  await waitFor(() => expect(screen.getByText('drive').closest('button')).toHaveFocus());
  await user.keyboard(',');
  await user.keyboard('.');
  expect(go.mock.calls).toEqual([
    [2, -1],
    [2, 1],
  ]);
});

it('shows the run that is open, around the moment at which the user looks', () => {
  run();
  const recorded = new Trace(Infinity);
  recorded.start([treeNode(1, 0, 'other')], 0);
  recorded.tick([[1, 'RUNNING']], [], 200);
  recorded.advance(300);
  onTestFinished(() => {
    useMoment.setState(atPresent);
    useShownTrace.setState({ recorded: null, nodes: [] });
  });
  act(() => useShownTrace.setState({ recorded, nodes: recorded.nodes }));
  expect(names()).toEqual(['other']);
  expect(timeAt(1)).toBe('3:20');
  act(() => useMoment.setState({ t: 100 }));
  fireEvent.pointerMove(rows(), { clientX: 300, clientY: 5 });
  expect(screen.getByRole('presentation')).toHaveTextContent(/idle at 1:40/);
  act(() => useShownTrace.setState({ recorded: null, nodes: [] }));
  expect(names()).toEqual(['root', 'drive', 'Turn']);
});
