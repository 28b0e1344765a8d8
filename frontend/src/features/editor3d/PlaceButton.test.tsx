import { Menu } from '@mantine/core';
import { IconCube } from '@tabler/icons-react';
import { fireEvent, screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { DRAGGED, PaletteBar, PlaceButton, PlaceMenu } from './PlaceButton';

describe('the palette of an editor', () => {
  it('places a thing by a click, and passes its data to the view by a drag', async () => {
    const onPlace = vi.fn();
    show(
      <PaletteBar label="Parts">
        <PlaceButton
          icon={IconCube}
          label="Box"
          testId="box"
          what={{ kind: 'box', size: 2 }}
          onPlace={onPlace}
        />
      </PaletteBar>,
    );
    const bar = screen.getByRole('toolbar', { name: 'Parts' });
    expect(bar).toHaveAttribute('aria-orientation', 'vertical');
    const button = screen.getByRole('button', { name: 'Place: Box' });
    await user.click(button);
    expect(onPlace).toHaveBeenCalledOnce();
    expect(button).toHaveAttribute('draggable', 'true');
    const setData = vi.fn();
    const dataTransfer = { setData, effectAllowed: 'none' };
    fireEvent.dragStart(button, { dataTransfer });
    expect(setData).toHaveBeenCalledExactlyOnceWith(DRAGGED, '{"kind":"box","size":2}');
    expect(dataTransfer.effectAllowed).toBe('copy');
    expect(DRAGGED).toBe('application/x-bts-thing');
  });

  it('has several things under one button', async () => {
    show(
      <PlaceMenu icon={IconCube} label="Robots" testId="robots" position="right-start">
        <Menu.Item>Rover</Menu.Item>
      </PlaceMenu>,
    );
    expect(screen.queryByRole('menuitem')).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Robots' }));
    expect(await screen.findByRole('menuitem', { name: 'Rover' })).toBeInTheDocument();
  });
});
