import { Menu } from '@mantine/core';
import { IconCube } from '@tabler/icons-react';
import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { openUniverse } from '../../../harness/documents';
import { show, user } from '../../../harness/testing';
import { showIn, type Editor } from './editing';
import { PaletteBar, PlaceButton, PlaceMenu } from './PlaceButton';

const view = { center: () => [0, 0] as const, forward: () => [1, 0] as const, cancel: () => false };
const placer = { aim: vi.fn(() => true), shift: vi.fn(), put: vi.fn(), focus: vi.fn() };
const onPlace = vi.fn();
let editor: Editor;
const what = { kind: 'box', size: 2 };

const webGl = vi.hoisted(() => ({ isThere: false }));
vi.mock('@/features/viewer/webgl', () => ({
  hasWebGl: () => webGl.isThere,
  isSoftwareWebGl: () => false,
}));

beforeEach(() => {
  vi.clearAllMocks();
  webGl.isThere = false;
  editor = openUniverse();
  showIn(editor, view, placer);
});

function button(isPlaceless = false) {
  show(
    <PaletteBar label="Parts">
      <PlaceButton
        editor={editor}
        icon={IconCube}
        label="Box"
        testId="box"
        what={what}
        onPlace={onPlace}
        isPlaceless={isPlaceless}
      />
    </PaletteBar>,
  );
  return screen.getByRole('button', { name: 'Place: Box' });
}

describe('the palette of an editor', () => {
  it('chooses by a click what the view places, and shows that it is chosen', async () => {
    const box = button();
    expect(screen.getByRole('toolbar', { name: 'Parts' })).toHaveAttribute('aria-orientation', 'vertical');
    expect(box).toHaveAttribute('aria-pressed', 'false');
    await user.click(box);
    expect(editor.store.getState().placing).toEqual({ name: 'Box', what });
    expect(box).toHaveAttribute('aria-pressed', 'true');
    await user.click(box);
    expect(box).toHaveAttribute('aria-pressed', 'false');
    expect(onPlace).not.toHaveBeenCalled();
  });

  it('lets a thing be dragged into the view', () => {
    fireEvent.pointerDown(button(), { button: 0, pointerId: 1, clientX: 0, clientY: 0 });
    fireEvent.pointerMove(window, { pointerId: 1, clientX: 50, clientY: 0 });
    expect(editor.store.getState().placing).toEqual({ name: 'Box', what });
    act(() => void fireEvent.pointerUp(document.body, { pointerId: 1, clientX: 60, clientY: 0 }));
    expect(placer.put).toHaveBeenCalledOnce();
  });

  it('places at once what has no place of its own', async () => {
    const box = button(true);
    expect(box).not.toHaveAttribute('aria-pressed');
    await user.click(box);
    expect(onPlace).toHaveBeenCalledOnce();
  });

  it('has several things under one button', async () => {
    show(
      <PlaceMenu editor={editor} icon={IconCube} label="Robots" testId="robots" position="right-start">
        <Menu.Item>Rover</Menu.Item>
      </PlaceMenu>,
    );
    expect(screen.queryByRole('menuitem')).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Robots' }));
    expect(await screen.findByRole('menuitem', { name: 'Rover' })).toBeInTheDocument();
  });

  it('waits for a view that is loading', async () => {
    webGl.isThere = true;
    showIn(editor, null);
    const box = button();
    show(
      <PlaceMenu editor={editor} icon={IconCube} label="Robots" testId="robots" position="right-start">
        <Menu.Item>Rover</Menu.Item>
      </PlaceMenu>,
    );
    expect(box).toBeDisabled();
    expect(screen.getByRole('button', { name: 'Robots' })).toBeDisabled();
    act(() => showIn(editor, view, placer));
    expect(screen.getByRole('button', { name: 'Robots' })).toBeEnabled();
    await user.click(box);
    expect(editor.store.getState().placing).toEqual({ name: 'Box', what });
    expect(placer.focus).toHaveBeenCalledOnce();
  });
});
