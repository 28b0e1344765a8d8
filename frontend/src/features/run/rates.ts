import { registerCommands, type UserCommand } from '@/commands/registry';
import { setRunTime, setSpeed, setTickRate } from '@/store/run/commands';
import { useRunStore } from '@/store/run/store';
import { setStatusRate, STATUS_RATES } from '@/store/session/statusRate';

/** The tick rates that can be chosen, in Hz. */
export const TICK_RATES = [1, 2, 5, 10, 20, 50, 100] as const;
/** The tick rate, in Hz, of a project whose settings have none. */
export const DEFAULT_TICK_HZ = 20;
/** The speeds of simulated time that can be chosen; zero means as fast as possible. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 5, 10, 0] as const;
/** Whether time waits for the tree. */
export const RUN_TIMES = ['exact', 'live'] as const;

const mayRun = () => useRunStore.getState().runBlocker === null;

const rows: readonly UserCommand[] = [
  ...TICK_RATES.map((hz): UserCommand => ({
    id: `run.tickRate.${hz}`,
    group: 'rates',
    labelKey: 'run:command.tickRate',
    labelValues: { hz },
    enabled: mayRun,
    run: () => setTickRate(hz),
  })),
  ...SPEEDS.map((speed): UserCommand => ({
    id: `run.speed.${speed}`,
    group: 'rates',
    labelKey: speed === 0 ? 'run:command.fullSpeed' : 'run:command.speed',
    labelValues: { speed },
    enabled: mayRun,
    run: () => setSpeed(speed),
  })),
  ...RUN_TIMES.map((time): UserCommand => ({
    id: `run.time.${time}`,
    group: 'rates',
    labelKey: `run:command.time.${time}`,
    enabled: mayRun,
    run: () => setRunTime(time),
  })),
  ...STATUS_RATES.map((hz): UserCommand => ({
    id: `run.statusRate.${hz}`,
    group: 'rates',
    labelKey: hz === 0 ? 'run:command.everyStatus' : 'run:command.statusRate',
    labelValues: { hz },
    run: () => setStatusRate(hz),
  })),
];

export const registerRateCommands = () => registerCommands(rows);
