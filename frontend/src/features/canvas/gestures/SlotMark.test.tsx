import { act, screen } from '@testing-library/react';
import { ReactFlow } from '@xyflow/react';
import { expect, it } from 'vitest';
import { setEditor } from '@/store/project/editor';
import { forgetEditor, showDrawn } from '../../../../harness/canvas';
import { SlotMark } from './SlotMark';

it('is drawn between blocks, at the slot', () => {
  forgetEditor();
  showDrawn(
    <ReactFlow>
      <SlotMark />
    </ReactFlow>,
  );
  expect(screen.queryByTestId('insertion-mark')).toBeNull();
  const slot = {
    parent: 'r',
    index: 1,
    kind: 'between',
    mark: { x: 10, y: 20, width: 4, height: 50 },
  } as const;
  act(() => setEditor({ slot }));
  expect(screen.getByTestId('insertion-mark')).toHaveStyle({
    transform: 'translate(10px, 20px)',
    width: '4px',
    height: '50px',
  });
  act(() => setEditor({ slot: { ...slot, kind: 'onto' } }));
  expect(screen.queryByTestId('insertion-mark')).toBeNull();
});
