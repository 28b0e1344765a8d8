import { Menu, Tooltip, UnstyledButton } from '@mantine/core';
import { IconCheck, IconChevronDown } from '@tabler/icons-react';
import { useState } from 'react';
import { setRunTime, setSpeed, setTickRate } from '@/store/run/commands';
import { useRunStore } from '@/store/run/store';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { usePlainWords } from '@/ui/hooks/usePlainWords';
import { DEFAULT_TICK_HZ, RUN_TIMES, SPEEDS, TICK_RATES } from './rates';
import classes from './run.module.css';

interface RateSelectProps {
  readonly label: string;
  readonly value: number;
  readonly options: readonly number[];
  readonly format: (value: number) => string;
  readonly testId: string;
  /** Whether the rates can only be read, as by guests and viewers. */
  readonly isDisabled: boolean;
  readonly onChoose: (value: number) => void;
}

function RateSelect({ label, value, options, format, testId, isDisabled, onChoose }: RateSelectProps) {
  const [isOpen, setOpen] = useState(false);
  return (
    <Menu position="bottom" disabled={isDisabled} opened={isOpen} onChange={setOpen}>
      <Tooltip label={label} disabled={isOpen}>
        <Menu.Target>
          <UnstyledButton
            className={classes['rate']}
            aria-label={`${label}: ${format(value)}`}
            data-testid={testId}
            disabled={isDisabled}
          >
            {format(value)}
            <IconChevronDown size={13} aria-hidden="true" />
          </UnstyledButton>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>
        <Menu.Label>{label}</Menu.Label>
        <Choices value={value} options={options} format={format} onChoose={onChoose} />
      </Menu.Dropdown>
    </Menu>
  );
}

type ChoicesProps = Pick<RateSelectProps, 'value' | 'options' | 'format' | 'onChoose'>;

function Choices({ value, options, format, onChoose }: ChoicesProps) {
  return (
    <Menu.RadioGroup value={String(value)} onChange={(chosen) => onChoose(Number(chosen))}>
      {options.map((option) => (
        <Menu.RadioItem
          key={option}
          closeMenuOnClick
          value={String(option)}
          checkIcon={<IconCheck size={15} />}
        >
          {format(option)}
        </Menu.RadioItem>
      ))}
    </Menu.RadioGroup>
  );
}

/** Returns the menus of the tick rate and of the speed of simulated time. */
function useRates(): readonly RateSelectProps[] {
  const t = usePlainWords('run');
  const tickHz = useProjectStore((state) => state.settings?.tick_hz ?? DEFAULT_TICK_HZ);
  const speed = useSessionStore((state) => state.speed);
  const isDisabled = useRunStore((state) => state.runBlocker !== null);
  return [
    {
      label: t('tickRate'),
      value: tickHz,
      options: TICK_RATES,
      format: (value) => `${value} Hz`,
      testId: 'tick-rate',
      isDisabled,
      onChoose: setTickRate,
    },
    {
      label: t('simSpeed'),
      value: speed,
      options: SPEEDS,
      format: (value) => (value === 0 ? t('fullSpeed') : `×${value}`),
      testId: 'sim-speed',
      isDisabled,
      onChoose: setSpeed,
    },
  ];
}

export function RateSelects() {
  return useRates().map((rate) => <RateSelect key={rate.testId} {...rate} />);
}

function useTime() {
  const time = useProjectStore((state) => state.settings?.time ?? 'live');
  const isDisabled = useRunStore((state) => state.runBlocker !== null);
  return { time, isDisabled };
}

function TimeChoices() {
  const t = usePlainWords('run');
  const { time } = useTime();
  return (
    <Menu.RadioGroup value={time} onChange={(chosen) => setRunTime(chosen === 'exact' ? 'exact' : 'live')}>
      {RUN_TIMES.map((value) => (
        <Menu.RadioItem key={value} closeMenuOnClick value={value} checkIcon={<IconCheck size={15} />}>
          {t(`timeChoices.${value}`)}
        </Menu.RadioItem>
      ))}
    </Menu.RadioGroup>
  );
}

/** Whether the time of the next run waits for the tree, as a chip that opens the choice. */
export function TimeChip() {
  const t = usePlainWords('run');
  const { time, isDisabled } = useTime();
  const [isOpen, setOpen] = useState(false);
  const label = `${t('time')}: ${t(`times.${time}`)}`;
  return (
    <Menu position="bottom" disabled={isDisabled} opened={isOpen} onChange={setOpen}>
      <Tooltip label={t('timeHelp')} disabled={isOpen} multiline maw={320}>
        <Menu.Target>
          <UnstyledButton
            className={classes['rate']}
            aria-label={label}
            data-testid="run-time"
            data-time={time}
            disabled={isDisabled}
          >
            {t(`timeNames.${time}`)}
            <IconChevronDown size={13} aria-hidden="true" />
          </UnstyledButton>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>
        <Menu.Label>{t('time')}</Menu.Label>
        <TimeChoices />
      </Menu.Dropdown>
    </Menu>
  );
}

/** The time of the next run as a menu, for windows that are too narrow for its chip. */
export function TimeMenu() {
  const t = usePlainWords('run');
  const { time, isDisabled } = useTime();
  return (
    <Menu.Sub>
      <Menu.Sub.Target>
        <Menu.Sub.Item
          leftSection={<span className={classes['unchecked']} />}
          data-testid="menu-time"
          disabled={isDisabled}
        >{`${t('time')}: ${t(`times.${time}`)}`}</Menu.Sub.Item>
      </Menu.Sub.Target>
      <Menu.Sub.Dropdown>
        <TimeChoices />
      </Menu.Sub.Dropdown>
    </Menu.Sub>
  );
}

/** The rates as menus, for windows that are too narrow for both. */
export function RateMenus() {
  return useRates().map(({ label, value, options, format, testId, isDisabled, onChoose }) => (
    <Menu.Sub key={testId}>
      <Menu.Sub.Target>
        <Menu.Sub.Item
          leftSection={<span className={classes['unchecked']} />}
          data-testid={`menu-${testId}`}
          disabled={isDisabled}
        >{`${label}: ${format(value)}`}</Menu.Sub.Item>
      </Menu.Sub.Target>
      <Menu.Sub.Dropdown>
        <Choices value={value} options={options} format={format} onChoose={onChoose} />
      </Menu.Sub.Dropdown>
    </Menu.Sub>
  ));
}
