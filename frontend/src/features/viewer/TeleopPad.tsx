import { ActionIcon, Button, CloseButton, Slider } from '@mantine/core';
import {
  IconArrowBackUp,
  IconArrowDown,
  IconArrowForwardUp,
  IconArrowUp,
  IconChevronDown,
  IconDeviceGamepad2,
} from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { isWorldPaused } from '@/store/session/clock';
import { useSessionStore } from '@/store/session/store';
import { PausedWorld } from '@/ui/PausedWorld';
import { canDrive, drive, halt, setDriving, useTeleop, type Direction } from '@/store/run/teleop';
import { useCramped } from './useCramped';
import classes from './viewer.module.css';

const KEYS: Record<string, Direction> = {
  KeyW: { linear: 1, angular: 0 },
  ArrowUp: { linear: 1, angular: 0 },
  KeyS: { linear: -1, angular: 0 },
  ArrowDown: { linear: -1, angular: 0 },
  KeyA: { linear: 0, angular: 1 },
  ArrowLeft: { linear: 0, angular: 1 },
  KeyD: { linear: 0, angular: -1 },
  ArrowRight: { linear: 0, angular: -1 },
};

const BUTTONS = [
  { code: 'KeyW', icon: IconArrowUp, key: 'ahead' },
  { code: 'KeyA', icon: IconArrowBackUp, key: 'left' },
  { code: 'KeyS', icon: IconArrowDown, key: 'back' },
  { code: 'KeyD', icon: IconArrowForwardUp, key: 'right' },
] as const;

/** Adds the directions of all held keys, so that forward and left together drive a curve. */
export function directionOf(held: Iterable<string>): Direction {
  let linear = 0;
  let angular = 0;
  for (const code of held) {
    linear += KEYS[code]?.linear ?? 0;
    angular += KEYS[code]?.angular ?? 0;
  }
  return { linear: Math.sign(linear), angular: Math.sign(angular) };
}

/** The pad that drives the robot with keys or buttons; the robot stops when none is held. */
export function TeleopPad() {
  const isOn = useTeleop((state) => state.isOn);
  const canBe = useSessionStore(
    ({ executor, introspection }) =>
      executor !== 'idle' && executor !== 'connected' && introspection?.role !== 'viewer',
  );
  return isOn && canBe ? <Pad /> : null;
}

function Pad() {
  const { t } = useTranslation('viewer');
  const root = useRef<HTMLDivElement>(null);
  const cramped = useCramped(root);
  const [isOpen, setOpen] = useState(false);
  const { linear, angular, direction } = useTeleop();
  const isPaused = useSessionStore(({ executor }) => executor === 'paused');
  const standsStill = useSessionStore(isWorldPaused);
  useHeldKeys();
  const isHeld = (code: string) => {
    const key = KEYS[code];
    return (key?.linear !== 0 && key?.linear === direction.linear) ||
      (key?.angular !== 0 && key?.angular === direction.angular)
      ? true
      : undefined;
  };
  if (cramped && !isOpen) {
    return (
      <div ref={root} className={classes['padFolded']} data-testid="teleop">
        <Button
          size="compact-sm"
          variant="default"
          aria-expanded={false}
          leftSection={<IconDeviceGamepad2 size={15} aria-hidden="true" />}
          title={t(isPaused ? 'drivePaused' : 'driveHelp')}
          onClick={() => setOpen(true)}
        >
          {t('driveKeys')}
        </Button>
        <CloseButton size="sm" aria-label={t('driveEnd')} onClick={() => setDriving(false)} />
      </div>
    );
  }
  return (
    <div ref={root} className={classes['pad']} role="group" aria-label={t('drive')} data-testid="teleop">
      <div className={classes['padKeys']}>
        {BUTTONS.map(({ code, icon: Icon, key }) => (
          <button
            key={code}
            type="button"
            className={classes['padKey']}
            data-code={code}
            data-held={isHeld(code)}
            aria-label={t(`driveTo.${key}`)}
            title={`${t(`driveTo.${key}`)} (${code.replace('Key', '')})`}
            onPointerDown={(event) => {
              event.currentTarget.setPointerCapture(event.pointerId);
              if (canDrive()) drive(directionOf([code]));
            }}
            onPointerUp={halt}
            onPointerCancel={halt}
          >
            <Icon size={15} aria-hidden="true" />
          </button>
        ))}
      </div>
      <div className={classes['padSpeeds']}>
        <label>
          {t('driveLinear', { value: linear.toFixed(2) })}
          <Slider
            size="xs"
            min={0.05}
            max={1}
            step={0.05}
            value={linear}
            label={null}
            thumbLabel={t('linearSpeed')}
            onChange={(value) => useTeleop.setState({ linear: value })}
          />
        </label>
        <label>
          {t('driveAngular', { value: angular.toFixed(1) })}
          <Slider
            size="xs"
            min={0.1}
            max={3}
            step={0.1}
            value={angular}
            label={null}
            thumbLabel={t('angularSpeed')}
            onChange={(value) => useTeleop.setState({ angular: value })}
          />
        </label>
      </div>
      <div className={classes['padEnd']}>
        <CloseButton size="sm" aria-label={t('driveEnd')} onClick={() => setDriving(false)} />
        {cramped ? (
          <ActionIcon
            variant="subtle"
            color="gray"
            aria-label={t('driveFold')}
            onClick={() => setOpen(false)}
          >
            <IconChevronDown size={16} />
          </ActionIcon>
        ) : null}
      </div>
      <span className={classes['padHelp']}>
        {standsStill ? <PausedWorld text={t(isPaused ? 'drivePaused' : 'driveStill')} /> : t('driveHelp')}
      </span>
    </div>
  );
}

const isTyping = (target: EventTarget | null) =>
  target instanceof HTMLElement &&
  (target.isContentEditable ||
    ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName) ||
    target.getAttribute('role') === 'slider');

/** Drives with the keys while the pad is open, wherever the focus is except in text fields. */
function useHeldKeys(): void {
  useEffect(() => {
    const held = new Set<string>();
    const stop = () => {
      held.clear();
      halt();
    };
    const onDown = (event: KeyboardEvent) => {
      if (!KEYS[event.code] || event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target))
        return;
      event.preventDefault();
      event.stopPropagation();
      if (event.repeat || !canDrive()) return;
      held.add(event.code);
      drive(directionOf(held));
    };
    const onUp = (event: KeyboardEvent) => {
      if (!held.delete(event.code)) return;
      event.stopPropagation();
      drive(directionOf(held));
    };
    const onHidden = () => document.hidden && stop();
    window.addEventListener('keydown', onDown, { capture: true });
    window.addEventListener('keyup', onUp, { capture: true });
    window.addEventListener('blur', stop);
    document.addEventListener('visibilitychange', onHidden);
    return () => {
      stop();
      window.removeEventListener('keydown', onDown, { capture: true });
      window.removeEventListener('keyup', onUp, { capture: true });
      window.removeEventListener('blur', stop);
      document.removeEventListener('visibilitychange', onHidden);
    };
  }, []);
}
