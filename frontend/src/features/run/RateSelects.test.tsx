import { Menu } from '@mantine/core';
import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openProject, show, user } from '../../../harness/testing';
import { RateMenus, RateSelects, TimeChip, TimeMenu } from './RateSelects';

const tickHz = () => useProjectStore.getState().settings?.tick_hz;

beforeEach(() => {
  openProject({});
  onTestFinished(() => {
    useSessionStore.setState(initialSession, true);
    useRunStore.setState(useRunStore.getInitialState(), true);
  });
});

describe('RateSelects', () => {
  it('offers rates and speeds, with the current one checked', async () => {
    show(<RateSelects />);
    await user.click(screen.getByRole('button', { name: 'Ticks a second: 20 Hz' }));
    const rates = screen.getAllByRole('menuitemradio');
    expect(rates.map(({ textContent }) => textContent)).toEqual([
      '1 Hz',
      '2 Hz',
      '5 Hz',
      '10 Hz',
      '20 Hz',
      '50 Hz',
      '100 Hz',
    ]);
    expect(rates.map((rate) => rate.getAttribute('aria-checked')).indexOf('true')).toBe(4);
    await user.click(screen.getByRole('menuitemradio', { name: '2 Hz' }));
    expect(tickHz()).toBe(2);
    await user.click(screen.getByRole('button', { name: 'Simulation speed: ×1' }));
    await user.click(await screen.findByRole('menuitemradio', { name: '×0.25' }));
    expect(useSessionStore.getState().speed).toBe(0.25);
    expect(screen.getByTestId('sim-speed')).toHaveTextContent('×0.25');
  });

  it('is read-only for users who may not run', () => {
    useRunStore.setState({ runBlocker: 'viewer' });
    show(<RateSelects />);
    expect(screen.getByTestId('tick-rate')).toBeDisabled();
    expect(screen.getByTestId('sim-speed')).toBeDisabled();
    act(() => useRunStore.setState({ runBlocker: null }));
    expect(screen.getByTestId('tick-rate')).toBeEnabled();
  });
});

describe('RateMenus', () => {
  const open = () =>
    show(
      <Menu opened>
        <Menu.Target>
          <button>menu</button>
        </Menu.Target>
        <Menu.Dropdown>
          <RateMenus />
        </Menu.Dropdown>
      </Menu>,
    );

  it('offers the same in a menu', async () => {
    open();
    expect(screen.getByTestId('menu-tick-rate')).toHaveTextContent('Ticks a second: 20 Hz');
    expect(screen.getByTestId('menu-sim-speed')).toHaveTextContent('Simulation speed: ×1');
    await user.hover(screen.getByTestId('menu-tick-rate'));
    fireEvent.click(await screen.findByRole('menuitemradio', { name: '50 Hz' }));
    expect(tickHz()).toBe(50);
  });

  it('is read-only for users who may not run', () => {
    useRunStore.setState({ runBlocker: 'guest' });
    open();
    expect(screen.getByTestId('menu-tick-rate')).toBeDisabled();
  });
});

describe('TimeMenu', () => {
  const open = () =>
    show(
      <Menu opened>
        <Menu.Target>
          <button>menu</button>
        </Menu.Target>
        <Menu.Dropdown>
          <TimeMenu />
        </Menu.Dropdown>
      </Menu>,
    );

  it('sets the time of the project, which is live if nothing is set', async () => {
    open();
    expect(screen.getByTestId('menu-time')).toHaveTextContent('Time of the next run: live');
    await user.hover(screen.getByTestId('menu-time'));
    fireEvent.click(await screen.findByRole('menuitemradio', { name: 'Exact (time waits for the tree)' }));
    expect(useProjectStore.getState().settings?.time).toBe('exact');
    expect(screen.getByTestId('menu-time')).toHaveTextContent('Time of the next run: exact');
  });

  it('is read-only for users who may not run', () => {
    useRunStore.setState({ runBlocker: 'guest' });
    open();
    expect(screen.getByTestId('menu-time')).toBeDisabled();
  });
});

describe('the chip of the time', () => {
  it('names the time of the next run, and changes it', async () => {
    show(<TimeChip />);
    const chip = screen.getByRole('button', { name: 'Time of the next run: live' });
    expect(chip).toHaveTextContent('Live');
    await user.click(chip);
    await user.click(await screen.findByRole('menuitemradio', { name: /^Exact/ }));
    expect(useProjectStore.getState().settings?.time).toBe('exact');
    expect(screen.getByTestId('run-time')).toHaveTextContent('Exact');
  });

  it('is read-only for users who may not run', () => {
    useRunStore.setState({ runBlocker: 'viewer' });
    show(<TimeChip />);
    expect(screen.getByTestId('run-time')).toBeDisabled();
  });
});
