import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { expandTrees } from '@/model/expand';
import { layoutTree } from '@/model/layout';
import { vocabulary } from '@/model/testing';
import type { ShownProblem } from '@/store/project/problems';
import { PANE, showInFlow } from '../../../../harness/canvas';
import { FlowProjection } from '../flow';
import { boundsOf, frameOf, shrink } from './overview';
import { Overview } from './Overview';

const PICTURE = { width: 168, height: 112 };
const diagram: Diagram = {
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'b'] },
    a: { type: 'Turn', color: '#123456' },
    b: { type: 'Nowhere' },
  },
};
const problem = { source: 'server', severity: 'error', node: 'b', code: '', message: '', hint: '' } as const;

function project(severity: ShownProblem['severity'] = 'error') {
  const shown = expandTrees(diagram, {}, new Set());
  return new FlowProjection().project({
    diagram,
    shown,
    layout: layoutTree(diagram, vocabulary),
    vocabulary,
    problems: new Map([['b', { ...problem, severity }]]),
    selection: new Set(),
  });
}

/** Records what is drawn: the colour and box of each block, and the lines. */
function recordPictures() {
  const boxes: [color: string, x: number, y: number, width: number, height: number][] = [];
  const lines: number[][] = [];
  const context = {
    fillStyle: '',
    scale: vi.fn(),
    beginPath: vi.fn(),
    stroke: vi.fn(),
    moveTo: (...point: number[]) => lines.push(point),
    lineTo: (...point: number[]) => lines.at(-1)!.push(...point),
    fillRect(x: number, y: number, width: number, height: number) {
      boxes.push([this.fillStyle, x, y, width, height]);
    },
  };
  vi.spyOn(HTMLCanvasElement.prototype, 'getContext').mockReturnValue(context as unknown as null);
  vi.spyOn(window, 'getComputedStyle').mockReturnValue({
    getPropertyValue: (name: string) => name.slice(6),
  } as unknown as CSSStyleDeclaration);
  return { boxes, lines, context };
}

const { nodes, edges } = project();
const boxOf = (id: string) => {
  const { position, width = 0, height = 0 } = nodes.find((each) => each.id === id)!;
  return { ...position, width, height };
};
const shrinking = shrink(boundsOf(['r', 'a', 'b'].map(boxOf)), PICTURE);
const at = (x: number, y: number) =>
  [shrinking.left + x * shrinking.sx, shrinking.top + y * shrinking.sy] as const;

describe('the picture', () => {
  it('has each block in its colour, and errors on top', () => {
    const { boxes } = recordPictures();
    showInFlow(<Overview nodes={nodes} edges={edges} />);
    expect(boxes.map(([color]) => color)).toEqual(['control', '#123456', 'unknown', 'failure-bright']);
    const { x, y, width, height } = boxOf('a');
    expect(boxes[1]!.slice(1)).toEqual([...at(x, y), width * shrinking.sx, height * shrinking.sy]);
  });

  it('marks no block that has a warning', () => {
    const { boxes } = recordPictures();
    showInFlow(<Overview {...project('warning')} />);
    expect(boxes).toHaveLength(3);
  });

  it('has a line from the middle of each parent to its child, and none to a missing one', () => {
    const { lines } = recordPictures();
    const lost = { ...edges[0]!, id: 'lost', target: 'lost' };
    showInFlow(<Overview nodes={nodes} edges={[...edges, lost]} />);
    const middle = (id: string) => {
      const { x, y, width, height } = boxOf(id);
      return at(x + width / 2, y + height / 2);
    };
    expect(lines).toEqual([
      [...middle('r'), ...middle('a')],
      [...middle('r'), ...middle('b')],
    ]);
  });

  it('has the resolution of the screen', () => {
    const { context } = recordPictures();
    vi.stubGlobal('devicePixelRatio', 2);
    showInFlow(<Overview nodes={nodes} edges={edges} />);
    vi.unstubAllGlobals();
    expect(context.scale).toHaveBeenCalledExactlyOnceWith(2, 2);
    expect(document.querySelector('canvas')).toHaveAttribute('width', '336');
    expect(document.querySelector('canvas')).toHaveAttribute('height', '224');
  });

  it('keeps a block of a large tree at least a pixel wide and two high', () => {
    const { boxes } = recordPictures();
    const far = { ...nodes[1]!, id: 'far', position: { x: 90_000, y: 90_000 }, width: 1, height: 1 };
    showInFlow(<Overview nodes={[...nodes, far]} edges={[]} />);
    expect(boxes[3]!.slice(3)).toEqual([1, 2]);
  });

  it('is drawn when the page is idle', () => {
    const { boxes } = recordPictures();
    const [request, cancel] = [vi.fn((_paint: () => void) => 7), vi.fn()];
    vi.stubGlobal('requestIdleCallback', request);
    vi.stubGlobal('cancelIdleCallback', cancel);
    const { unmount } = showInFlow(<Overview nodes={nodes} edges={edges} />);
    expect(boxes).toEqual([]);
    expect(request).toHaveBeenCalledExactlyOnceWith(expect.any(Function), { timeout: 200 });
    request.mock.calls[0]![0]();
    expect(boxes).not.toEqual([]);
    unmount();
    expect(cancel).toHaveBeenCalledWith(7);
    vi.unstubAllGlobals();
  });
});

describe('the visible part', () => {
  let flow: ReturnType<typeof showInFlow>;
  const map = () => screen.getByTestId('minimap');

  beforeEach(() => {
    flow = showInFlow(<Overview nodes={nodes} edges={edges} />);
  });

  it('is framed, and the frame follows the view', () => {
    const frame = map().querySelector<HTMLElement>('div')!;
    for (const [x, y, zoom] of [
      [0, 0, 1],
      [-100, -40, 2],
    ] as const) {
      act(() => flow.store.setState({ transform: [x, y, zoom] }));
      const view = { x: -x / zoom, y: -y / zoom, width: PANE.width / zoom, height: PANE.height / zoom };
      const box = frameOf(view, shrinking, PICTURE);
      expect(frame.style.transform).toBe(`translate(${box.x}px, ${box.y}px)`);
      expect(parseFloat(frame.style.width)).toBeCloseTo(box.width);
      expect(parseFloat(frame.style.height)).toBeCloseTo(box.height);
    }
  });

  it('moves to where the picture is pressed, and follows a drag', () => {
    map().getBoundingClientRect = () => new DOMRect(500, 400, 168, 112);
    act(() => flow.store.setState({ transform: [0, 0, 0.5] }));
    const { x, y } = boxOf('b');
    const [px, py] = at(x, y);
    fireEvent.pointerDown(map(), { clientX: 500 + px, clientY: 400 + py, pointerId: 3 });
    const [to] = flow.view.setViewport.mock.lastCall!;
    expect(to.zoom).toBe(0.5);
    expect(to.x).toBeCloseTo(PANE.width / 2 - x * 0.5);
    expect(to.y).toBeCloseTo(PANE.height / 2 - y * 0.5);
    fireEvent.pointerMove(map(), { clientX: 500 + px + 10, clientY: 400 + py, pointerId: 3 });
    expect(flow.view.setViewport).toHaveBeenCalledTimes(2);
    fireEvent.pointerUp(map(), { pointerId: 3 });
    fireEvent.pointerMove(map(), { clientX: 500, clientY: 400, pointerId: 3 });
    expect(flow.view.setViewport).toHaveBeenCalledTimes(2);
  });

  it('is restored when Escape cancels the drag', () => {
    act(() => flow.store.setState({ transform: [-10, -20, 0.5] }));
    fireEvent.pointerDown(map(), { clientX: 20, clientY: 20, pointerId: 3 });
    fireEvent.keyDown(map(), { key: 'Escape' });
    expect(flow.view.setViewport.mock.lastCall![0]).toEqual({ x: -10, y: -20, zoom: 0.5 });
  });

  it('stays if the pointer only passes, or another button is pressed', () => {
    fireEvent.pointerMove(map(), { clientX: 10, clientY: 10, pointerId: 3 });
    fireEvent.pointerDown(map(), { clientX: 10, clientY: 10, pointerId: 3, button: 2 });
    expect(flow.view.setViewport).not.toHaveBeenCalled();
  });
});
