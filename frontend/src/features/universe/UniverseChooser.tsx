import { Alert, Button, Group, Loader, NumberInput, SegmentedControl, Stack, Text } from '@mantine/core';
import { IconInfoCircle } from '@tabler/icons-react';
import { useQuery } from '@tanstack/react-query';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import type { UniverseInfo } from '@/api/types';
import { ownRobots, openNewRobot } from '@/store/dialogs/newRobot';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { ChoiceCards } from './ChoiceCards';
import { OUTSIDE, titled } from './titles';
import classes from './universe.module.css';
import { closeUniverseChooser, useUniverseChooser } from '@/store/dialogs/universeChooser';

const OWN = /^universes\/([^/]+)\.yaml$/;
/** The value for the robot that the universe names. */
const OF_UNIVERSE = '';

type Scope = 'project' | 'once';

/** The form that chooses universe, robot and seed: for the project, or until the page closes. */
export function UniverseChooser() {
  const { t } = useTranslation('universe');
  const { t: title } = useTranslation('worlds');
  const settings = useProjectStore((state) => state.settings);
  const paths = useProjectStore((state) => state.files);
  const once = useUniverseChoice();
  const universes = useQuery({ queryKey: ['universes'], queryFn: api.universes, staleTime: Infinity });
  const robots = useQuery({ queryKey: ['robots'], queryFn: api.robots, staleTime: Infinity });
  const [scope, setScope] = useState<Scope>(once.universe === null ? 'project' : 'once');
  const [universe, setUniverse] = useState(once.universe ?? settings?.universe ?? '');
  const [robot, setRobot] = useState(once.robot ?? settings?.robot ?? OF_UNIVERSE);
  const [seed, setSeed] = useState(once.seed);
  const root = useRef<HTMLDivElement>(null);
  const first = useUniverseChooser((state) => state.first);
  const isReady = !universes.isPending && !robots.isPending;
  useEffect(() => {
    // Waits until the dialogue has focused its first button, then moves the focus to the cards for the arrow
    // keys.
    const timer = setTimeout(() => {
      const checked = root.current?.querySelectorAll<HTMLElement>('input[type="radio"]:checked');
      checked?.[first === 'robot' ? 1 : 0]?.focus();
    });
    return () => clearTimeout(timer);
  }, [isReady, first]);

  const own = Object.keys(paths)
    .map((path) => OWN.exec(path)?.[1])
    .filter((id): id is string => id !== undefined);
  const names = new Set(own);
  const places: UniverseInfo[] = [
    ...own.map((id) => ({ id, name: id, description: t('own') })),
    ...(universes.data ?? [])
      .filter(({ id }) => !names.has(id))
      .map((info) => titled(title, 'universe', info)),
  ];
  const ownMachines = ownRobots(Object.keys(paths));
  const machines: UniverseInfo[] = [
    { id: OF_UNIVERSE, name: t('robotOfUniverse'), description: t('robotOfUniverseHint') },
    ...ownMachines.map((id) => ({ id, name: id, description: t('ownRobot') })),
    ...(robots.data ?? [])
      .filter(({ id }) => !ownMachines.includes(id))
      .map((info) => titled(title, 'robot', info)),
  ];
  const isOutside = universe === OUTSIDE && !names.has(OUTSIDE);

  const confirm = () => {
    const wanted = robot === OF_UNIVERSE ? null : robot;
    if (scope === 'once') useUniverseChoice.setState({ universe, robot: wanted, seed });
    else {
      useUniverseChoice.setState({ universe: null, robot: null, seed });
      const { setSettings } = useProjectStore.getState();
      setSettings({ universe, robot: wanted ?? undefined });
    }
    closeUniverseChooser();
  };

  /** Opens a robot of the project in its editor, or offers to copy a built-in robot. */
  const changeRobot = () => {
    closeUniverseChooser();
    if (ownMachines.includes(robot)) openFile(`robots/${robot}/robot.yaml`);
    else openNewRobot(robot);
  };

  if (!isReady) return <Loader size="sm" role="status" aria-label={t('loading')} />;
  return (
    <Stack ref={root} gap="md" data-testid="worlds">
      <Text size="sm" fw={600}>
        {t('universe')}
      </Text>
      <ChoiceCards label={t('universe')} items={places} chosen={universe} onChoose={setUniverse} isFirst />
      {isOutside ? (
        <Alert variant="light" icon={<IconInfoCircle size={18} />} title={t('outside')} data-testid="outside">
          {t('outsideHint')}
        </Alert>
      ) : (
        <>
          <Text size="sm" fw={600}>
            {t('robot')}
          </Text>
          <ChoiceCards label={t('robot')} items={machines} chosen={robot} onChoose={setRobot} />
          {robot === OF_UNIVERSE ? null : (
            <Group>
              <Button variant="default" size="xs" data-testid="change-robot" onClick={changeRobot}>
                {t(ownMachines.includes(robot) ? 'changeRobot' : 'changeCopy')}
              </Button>
            </Group>
          )}
        </>
      )}
      <Group justify="space-between" align="flex-end" className={classes['decision']}>
        <Group align="flex-end">
          <NumberInput
            w={140}
            label={t('seed')}
            description={t('seedHint')}
            inputWrapperOrder={['label', 'input', 'description']}
            data-testid="seed"
            disabled={isOutside}
            min={0}
            max={2 ** 31 - 1}
            allowDecimal={false}
            value={seed}
            onChange={(value) => setSeed(Number(value) || 0)}
          />
          <SegmentedControl
            aria-label={t('scope')}
            value={scope}
            onChange={(value) => setScope(value as Scope)}
            data={[
              { value: 'project', label: t('forProject') },
              { value: 'once', label: t('forOnce') },
            ]}
          />
        </Group>
        <Button data-testid="choose-world" disabled={universe === ''} onClick={confirm}>
          {t('choose')}
        </Button>
      </Group>
    </Stack>
  );
}
