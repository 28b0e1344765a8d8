import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { Introspection } from '@/generated/messages';
import { setDriving, useTeleop } from '@/store/run/teleop';
import { openSession, show, user } from '../../../harness/testing';
import { directionOf, TeleopPad } from './TeleopPad';

async function pad(introduction: Partial<Introspection> = {}) {
  const executor = await openSession(introduction);
  onTestFinished(() => setDriving(false));
  show(
    <>
      <TeleopPad />
      <input data-testid="field" />
      <select data-testid="choice" />
      <div data-testid="slider" role="slider" aria-valuenow={1} tabIndex={0} />
    </>,
  );
  act(() => setDriving(true));
  return executor;
}

const direction = () => useTeleop.getState().direction;
const STILL = { linear: 0, angular: 0 };
/** Presses a key; returns whether the pad handled it. */
const down = (code: string, more: object = {}, target: Element | Window = window) =>
  !fireEvent.keyDown(target, { code, ...more });
const up = (code: string) => fireEvent.keyUp(window, { code });

beforeEach(() => useTeleop.setState({ linear: 0.3, angular: 1 }));

describe('directionOf', () => {
  it.each([
    [['KeyW'], 1, 0],
    [['ArrowUp'], 1, 0],
    [['KeyS'], -1, 0],
    [['ArrowDown'], -1, 0],
    [['KeyA'], 0, 1],
    [['ArrowLeft'], 0, 1],
    [['KeyD'], 0, -1],
    [['ArrowRight'], 0, -1],
    [['KeyW', 'KeyA'], 1, 1],
    [['KeyW', 'ArrowUp'], 1, 0],
    [['KeyW', 'KeyS'], 0, 0],
    [['KeyX'], 0, 0],
    [[], 0, 0],
  ])('of %o', (held, linear, angular) => {
    expect(directionOf(held)).toEqual({ linear, angular });
  });
});

describe('the pad', () => {
  it('is shown while a world is driven', async () => {
    await pad();
    expect(screen.getByRole('group', { name: 'Drive by hand' })).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Stop driving by hand' }));
    expect(useTeleop.getState().isOn).toBe(false);
    expect(screen.queryByTestId('teleop')).toBeNull();
  });

  it.each([{ role: 'viewer' }, { state: 'connected' }, { state: 'idle' }] as const)(
    'is absent with %o',
    async (introduction) => {
      await pad(introduction);
      expect(screen.queryByTestId('teleop')).toBeNull();
    },
  );

  it('explains its keys, and that a pause stops it', async () => {
    const executor = await pad();
    expect(screen.getByText('Hold W A S D or the arrow keys')).toBeInTheDocument();
    executor.introduce({ state: 'paused' });
    expect(screen.getByText(/Resume or stop the program to drive/)).toBeInTheDocument();
    expect(down('KeyW')).toBe(true);
    expect(direction()).toEqual(STILL);
    fireEvent.pointerDown(screen.getByRole('button', { name: 'Ahead' }), { pointerId: 1 });
    expect(direction()).toEqual(STILL);
  });

  it.each([
    ['Ahead', 'W', { linear: 1, angular: 0 }],
    ['Turn left', 'A', { linear: 0, angular: 1 }],
    ['Back', 'S', { linear: -1, angular: 0 }],
    ['Turn right', 'D', { linear: 0, angular: -1 }],
  ])('drives by its button %s while it is pressed', async (name, key, wanted) => {
    const executor = await pad();
    const button = screen.getByRole('button', { name });
    expect(button).toHaveAttribute('title', `${name} (${key})`);
    fireEvent.pointerDown(button, { pointerId: 1 });
    expect(direction()).toEqual(wanted);
    expect(executor.sentAs('teleop').at(-1)).toEqual({
      linear: wanted.linear * 0.3,
      angular: wanted.angular,
    });
    const held = screen.getAllByRole('button').filter((each) => each.dataset['held'] === 'true');
    expect(held).toEqual([button]);
    fireEvent.pointerUp(button);
    expect(direction()).toEqual(STILL);
    fireEvent.pointerDown(button, { pointerId: 1 });
    fireEvent.pointerCancel(button);
    expect(direction()).toEqual(STILL);
  });

  it('drives by keys wherever the focus is, all that are held together', async () => {
    await pad();
    expect(down('KeyW')).toBe(true);
    expect(down('ArrowLeft')).toBe(true);
    expect(direction()).toEqual({ linear: 1, angular: 1 });
    expect(down('KeyW', { repeat: true })).toBe(true);
    up('KeyX');
    up('KeyW');
    expect(direction()).toEqual({ linear: 0, angular: 1 });
    up('ArrowLeft');
    expect(direction()).toEqual(STILL);
  });

  it('ignores keys with another meaning', async () => {
    await pad();
    for (const key of ['ctrlKey', 'metaKey', 'altKey']) expect(down('KeyW', { [key]: true })).toBe(false);
    for (const id of ['field', 'choice', 'slider'])
      expect(down('KeyW', {}, screen.getByTestId(id))).toBe(false);
    expect(down('KeyX')).toBe(false);
    expect(direction()).toEqual(STILL);
  });

  it('stops when the page is left or hidden', async () => {
    await pad();
    down('KeyW');
    fireEvent.blur(window);
    expect(direction()).toEqual(STILL);
    down('KeyS');
    fireEvent(document, new Event('visibilitychange'));
    expect(direction()).toEqual({ linear: -1, angular: 0 });
    Object.defineProperty(document, 'hidden', { configurable: true, value: true });
    fireEvent(document, new Event('visibilitychange'));
    Reflect.deleteProperty(document, 'hidden');
    expect(direction()).toEqual(STILL);
  });

  it('stops, and ignores keys, when it is closed', async () => {
    await pad();
    down('KeyW');
    act(() => useTeleop.setState({ isOn: false }));
    expect(direction()).toEqual(STILL);
    expect(down('KeyW')).toBe(false);
  });

  it('drives at the chosen speed', async () => {
    await pad();
    expect(screen.getByText('Speed 0.30 m/s')).toBeInTheDocument();
    expect(screen.getByText('Turning 1.0 rad/s')).toBeInTheDocument();
    const [linear, angular] = [
      screen.getByRole('slider', { name: 'Speed by hand' }),
      screen.getByRole('slider', { name: 'Turning by hand' }),
    ];
    fireEvent.keyDown(linear, { key: 'ArrowRight' });
    fireEvent.keyDown(angular, { key: 'ArrowLeft' });
    expect(useTeleop.getState().linear).toBeCloseTo(0.35);
    expect(useTeleop.getState().angular).toBeCloseTo(0.9);
    const range = (slider: HTMLElement) =>
      ['aria-valuemin', 'aria-valuemax'].map((name) => Number(slider.getAttribute(name)));
    expect([range(linear), range(angular)]).toEqual([
      [0.05, 1],
      [0.1, 3],
    ]);
  });
});
