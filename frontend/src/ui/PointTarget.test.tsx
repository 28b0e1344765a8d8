import { Menu } from '@mantine/core';
import { fireEvent, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show } from '../../harness/testing';
import { PointTarget } from './PointTarget';

it('is a point of the window that assistive technology does not meet', () => {
  const { container } = show(
    <Menu opened>
      <PointTarget x={30} y={40} label="Things" onClose={vi.fn()} />
      <Menu.Dropdown>
        <Menu.Item>One</Menu.Item>
      </Menu.Dropdown>
    </Menu>,
  );
  const point = container.querySelector<HTMLElement>('[aria-haspopup]');
  expect(point).toHaveAttribute('aria-hidden', 'true');
  expect([point?.style.left, point?.style.top]).toEqual(['30px', '40px']);
  expect(screen.getByRole('menu', { name: 'Things' })).toBeInTheDocument();
  expect(screen.getByRole('menuitem', { name: 'One' })).toBeInTheDocument();
});

it('closes by Escape before the menu has the focus, and the key means nothing else then', () => {
  const close = vi.fn();
  const other = vi.fn();
  show(
    <>
      <input aria-label="Beside" onKeyDown={other} />
      <Menu opened trapFocus={false}>
        <PointTarget x={30} y={40} label="Things" onClose={close} />
        <Menu.Dropdown>
          <Menu.Item>One</Menu.Item>
        </Menu.Dropdown>
      </Menu>
    </>,
  );
  const page = screen.getByRole('textbox', { name: 'Beside' });
  fireEvent.keyDown(page, { key: 'a' });
  expect([close.mock.calls.length, other.mock.calls.length]).toEqual([0, 1]);
  fireEvent.keyDown(page, { key: 'Escape' });
  expect([close.mock.calls.length, other.mock.calls.length]).toEqual([1, 1]);
  screen.getByRole('menuitem', { name: 'One' }).focus();
  fireEvent.keyDown(screen.getByRole('menuitem', { name: 'One' }), { key: 'Escape' });
  expect(close).toHaveBeenCalledTimes(1);
});
