import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { perform, useCommandTable } from '@/commands/registry';
import { setDriving, useTeleop } from '@/store/run/teleop';
import { openSession, show, user } from '../../../harness/testing';
import { basicPage } from '../../../harness/basicPage';
import { setMeasuring, useMeasuring } from './measuring';
import { loadViewOptions } from './viewOptions';
import { ViewerToolbar } from './ViewerToolbar';

const OPTIONS = { ...loadViewOptions(), camera: false, follow: false };

function toolbar(more: Partial<typeof OPTIONS> = {}) {
  const onChange = vi.fn();
  const options = { ...OPTIONS, ...more };
  const shown = show(<ViewerToolbar options={options} onChange={onChange} />);
  const change = (next: Partial<typeof OPTIONS>) =>
    shown.rerender(<ViewerToolbar options={{ ...options, ...next }} onChange={onChange} />);
  return { ...shown, onChange, change };
}

const button = (name: string) => screen.getByRole('button', { name });

beforeEach(() => setMeasuring(false));

describe('the toolbar of the 3D view', () => {
  it('shows and hides the helpers', async () => {
    const { onChange } = toolbar({ rays: true, frames: false });
    await user.click(button('Show in the view'));
    const items = await screen.findAllByRole('menuitemcheckbox');
    expect(items.map(({ textContent }) => textContent)).toEqual([
      'LIDAR rays',
      'Trail',
      'Grid',
      'Coordinate frames',
      "Camera's field of view",
      "Robot's camera",
    ]);
    expect(items.map((item) => item.getAttribute('aria-checked'))).toEqual([
      'true',
      'true',
      'true',
      'false',
      'true',
      'false',
    ]);
    await user.click(items[0]!);
    expect(onChange).toHaveBeenLastCalledWith({ rays: false });
    await user.click(items[3]!);
    expect(onChange).toHaveBeenLastCalledWith({ frames: true });
  });

  it('switches following the robot on and off', async () => {
    const { onChange, change } = toolbar();
    expect(button('Follow the robot')).toHaveAttribute('aria-pressed', 'false');
    await user.click(button('Follow the robot'));
    expect(onChange).toHaveBeenLastCalledWith({ follow: true });
    change({ follow: true });
    expect(button('Follow the robot')).toHaveAttribute('aria-pressed', 'true');
    await user.click(button('Follow the robot'));
    expect(onChange).toHaveBeenLastCalledWith({ follow: false });
  });

  it('moves the camera above, and to the side', async () => {
    const { onChange } = toolbar();
    await user.click(button('Top view'));
    expect(onChange).toHaveBeenLastCalledWith({ viewpoint: { kind: 'top' }, follow: false });
    await user.click(button('Default view'));
    expect(onChange).toHaveBeenLastCalledWith({ viewpoint: { kind: 'default' }, follow: true });
    expect(button('Top view')).not.toHaveAttribute('aria-pressed');
  });

  it('starts and ends measuring', async () => {
    toolbar();
    await user.click(button('Measure a distance'));
    expect(useMeasuring.getState().isOn).toBe(true);
    expect(button('Measure a distance')).toHaveAttribute('aria-pressed', 'true');
    await user.click(button('Measure a distance'));
    expect(useMeasuring.getState().isOn).toBe(false);
  });

  it('starts and ends driving by hand', async () => {
    await openSession();
    toolbar();
    await user.click(button('Drive by hand'));
    expect(useTeleop.getState().isOn).toBe(true);
    expect(button('Drive by hand')).toHaveAttribute('aria-pressed', 'true');
    await user.click(button('Drive by hand'));
    expect(useTeleop.getState().isOn).toBe(false);
    act(() => setDriving(false));
  });
});

describe('the commands of the 3D view', () => {
  it('do the same, as long as there is a world', () => {
    const { onChange, change, unmount } = toolbar({ grid: true });
    const run = (id: string) => act(() => perform(`view3d.${id}`));
    run('follow');
    expect(onChange).toHaveBeenLastCalledWith({ follow: true });
    run('top');
    expect(onChange).toHaveBeenLastCalledWith({ viewpoint: { kind: 'top' }, follow: false });
    run('reset');
    expect(onChange).toHaveBeenLastCalledWith({ viewpoint: { kind: 'default' }, follow: true });
    run('measure');
    expect(useMeasuring.getState().isOn).toBe(true);
    run('measure');
    expect(useMeasuring.getState().isOn).toBe(false);
    run('show.grid');
    expect(onChange).toHaveBeenLastCalledWith({ grid: false });
    change({ grid: false });
    run('show.grid');
    expect(onChange).toHaveBeenLastCalledWith({ grid: true });
    const mine = () =>
      Object.values(useCommandTable.getState().commands).filter(({ id }) => id.startsWith('view3d.'));
    expect(mine()).toHaveLength(10);
    expect(mine().every(({ group }) => group === 'view')).toBe(true);
    unmount();
    expect(mine()).toEqual([]);
  });
});

it('is driving alone in the basic page, and a measurement that is on', () => {
  basicPage();
  toolbar();
  expect(screen.getAllByRole('button').map(({ ariaLabel }) => ariaLabel)).toEqual(['Drive by hand']);
  act(() => setMeasuring(true));
  expect(button('Measure a distance')).toBeInTheDocument();
});
