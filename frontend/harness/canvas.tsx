import { MantineProvider } from '@mantine/core';
import { renderHook } from '@testing-library/react';
import { ReactFlowProvider, useStoreApi, type ReactFlowState, type Viewport } from '@xyflow/react';
import { useState, type ReactNode } from 'react';
import { onTestFinished, vi } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { useEditorStore } from '@/store/project/editor';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { theme } from '@/ui/theme';
import { openProject, type TestProject } from './testing';

type Animation = { readonly duration?: number } | undefined;

/** The part of React Flow that moves the view: it needs a browser, and records each wish here. */
const recordingView = () => ({
  setViewport: vi.fn((_viewport: Viewport, _options: Animation) => Promise.resolve(undefined)),
  scaleBy: vi.fn((_factor: number, _options: Animation) => Promise.resolve(true)),
  scaleTo: vi.fn((_zoom: number, _options: Animation) => Promise.resolve(true)),
});

/** The size of a canvas in these tests. */
export const PANE = { width: 800, height: 600 } as const;

type View = ReturnType<typeof recordingView>;

/** Gives the store a view and a size before anything below looks for them. */
function Pane({ view, children }: { readonly view: View; readonly children: ReactNode }) {
  const store = useStoreApi();
  useState(() => store.setState({ panZoom: view as unknown as ReactFlowState['panZoom'], ...PANE }));
  return children;
}

/**
 * Calls a hook, and shows an element beside it, where React Flow has its store and draws nothing:
 * points of the window are points of the flow then.
 */
export function inFlow<T>(use: () => T, element: ReactNode = null, Room: typeof Pane = Pane) {
  const view = recordingView();
  const { result, rerender, unmount } = renderHook(() => ({ used: use(), store: useStoreApi() }), {
    wrapper: ({ children }) => (
      <MantineProvider theme={theme} env="test" withCssVariables={false} withGlobalClasses={false}>
        <ReactFlowProvider>
          <Room view={view}>
            {element}
            {children}
          </Room>
        </ReactFlowProvider>
      </MantineProvider>
    ),
  });
  return { used: () => result.current.used, store: result.current.store, view, rerender, unmount };
}

/** Shows an element where React Flow has its store and draws nothing. */
export const showInFlow = (element: ReactNode) => inFlow(() => undefined, element);

/** Shows an element in which React Flow draws, and makes the view itself. */
export const showDrawn = (element: ReactNode) =>
  inFlow(
    () => undefined,
    element,
    ({ children }) => children,
  );

/** Opens a project whose first tree is any diagram: with drafts, places, or from left to right. */
export function openDiagram(diagram: Partial<Diagram>, { texts, ...more }: Omit<TestProject, 'trees'> = {}) {
  const whole: Diagram = { ...emptyDiagram('Main'), ...diagram };
  openProject({ ...more, texts: { ...texts, [`trees/${whole.id}.json`]: JSON.stringify(whole) } });
  if (more.selected) useProjectStore.getState().select(whole.id, more.selected);
  useProjectStore.getState().setActiveTree(whole.id);
  forgetEditor();
}

/** Empties what the editor and a run show, now and after the test. */
export function forgetEditor(): void {
  const forget = () => {
    useEditorStore.setState(useEditorStore.getInitialState(), true);
    useLiveStore.getState().clear();
  };
  forget();
  onTestFinished(forget);
}

/** What is selected, the diagram and the editor of the tests' tree, as they are now. */
export const now = {
  diagram: (tree = 'Main'): Diagram => useProjectStore.getState().diagrams[tree]!,
  selection: () => useProjectStore.getState().selection,
  editor: () => useEditorStore.getState(),
};
