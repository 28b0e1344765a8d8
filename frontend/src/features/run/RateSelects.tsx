import { Menu, Tooltip, UnstyledButton } from '@mantine/core';
import { IconChevronDown } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { setSpeed, setTickRate } from '@/store/run/commands';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import classes from './run.module.css';

const TICK_RATES = [1, 2, 5, 10, 20, 50, 100];
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];
const DEFAULT_TICK_HZ = 20;

interface RateSelectProps {
  readonly label: string;
  readonly value: number;
  readonly options: readonly number[];
  readonly format: (value: number) => string;
  readonly testId: string;
  readonly onChoose: (value: number) => void;
}

function RateSelect({ label, value, options, format, testId, onChoose }: RateSelectProps) {
  return (
    <Menu position="bottom">
      <Tooltip label={label}>
        <Menu.Target>
          <UnstyledButton
            className={classes['rate']}
            aria-label={`${label}: ${format(value)}`}
            data-testid={testId}
          >
            {format(value)}
            <IconChevronDown size={13} aria-hidden="true" />
          </UnstyledButton>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>
        <Menu.Label>{label}</Menu.Label>
        {options.map((option) => (
          <Menu.Item key={option} fw={option === value ? 600 : 400} onClick={() => onChoose(option)}>
            {format(option)}
          </Menu.Item>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}

export function TickRateSelect() {
  const { t } = useTranslation('run');
  const tickHz = useProjectStore((state) => state.settings?.tick_hz ?? DEFAULT_TICK_HZ);
  return (
    <RateSelect
      label={t('tickRate')}
      value={tickHz}
      options={TICK_RATES}
      format={(value) => `${value} Hz`}
      testId="tick-rate"
      onChoose={setTickRate}
    />
  );
}

export function SpeedSelect() {
  const { t } = useTranslation('run');
  const speed = useSessionStore((state) => state.speed);
  return (
    <RateSelect
      label={t('simSpeed')}
      value={speed}
      options={SPEEDS}
      format={(value) => `×${value}`}
      testId="sim-speed"
      onChoose={setSpeed}
    />
  );
}
