import { Menu } from '@mantine/core';
import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../harness/testing';
import { PointTarget } from './PointTarget';

it('is a point of the window that assistive technology does not meet', () => {
  const { container } = show(
    <Menu opened>
      <PointTarget x={30} y={40} label="Things" />
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
