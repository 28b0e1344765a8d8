import { Tooltip } from '@mantine/core';
import {
  IconAlertTriangle,
  IconCircleCheck,
  IconHourglass,
  IconLayoutDashboard,
  IconLayoutSidebar,
  IconPlugConnected,
  IconPlugConnectedX,
  IconWorld,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { Hint } from '@/features/onboarding/Hint';
import { titleOf } from '@/model/document/glance';
import { openUniverseChooser } from '@/store/dialogs/universeChooser';
import { countProblems } from '@/store/problems/list';
import { useProblems } from '@/store/problems/useProblems';
import { useIsBack, useMoment } from '@/store/moment/store';
import type { Moment } from '@/store/recording/types';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { useMotion } from '@/store/session/motion';
import { useSessionStore } from '@/store/session/store';
import { useIsBasic } from '@/store/viewMode';
import classes from './frame.module.css';
import { showPanel } from '@/workspace/tabs';
import { usePlainWords } from '@/ui/hooks/usePlainWords';

export function StatusBar() {
  const { t } = useTranslation('frame');
  return (
    <footer className={classes['statusBar']} aria-label={t('status.label')}>
      <ConnectionStatus />
      <UniverseButton />
      <ProblemCount />
      <LongTick />
      <Hint />
      <span className={classes['spacer']} />
      <Figures />
      <ViewModeButton />
    </footer>
  );
}

/** The switch between what a first project needs and everything. */
function ViewModeButton() {
  const { t } = useTranslation('frame');
  const isBasic = useIsBasic();
  const Icon = isBasic ? IconLayoutDashboard : IconLayoutSidebar;
  return (
    <Tooltip label={t(isBasic ? 'viewMode.moreHelp' : 'viewMode.lessHelp')} multiline maw={280}>
      <button
        type="button"
        className={classes['statusButton']}
        data-testid="view-mode"
        data-mode={isBasic ? 'basic' : 'full'}
        onClick={() => perform('view.mode')}
      >
        <Icon size={14} aria-hidden="true" />
        {t(isBasic ? 'viewMode.more' : 'viewMode.less')}
      </button>
    </Tooltip>
  );
}

function ConnectionStatus() {
  const { t } = useTranslation('frame');
  const connection = useSessionStore(({ connection, silentS }) =>
    connection === 'open' && silentS > 0 ? 'silent' : connection,
  );
  const Icon = connection === 'open' ? IconPlugConnected : IconPlugConnectedX;
  return (
    <span className={classes['statusItem']} data-connection={connection}>
      <Icon size={14} aria-hidden="true" />
      {t(`connection.${connection}`)}
    </span>
  );
}

/** The universe of the next run; a click opens the chooser. */
function UniverseButton() {
  const { t } = useTranslation('frame');
  const own = useProjectStore((state) => state.settings?.universe ?? '');
  const { t: title } = useTranslation('worlds');
  const once = useUniverseChoice((state) => state.universe);
  const id = once ?? own;
  const isOwn = useProjectStore((state) => `universes/${id}.yaml` in state.files);
  const plain = titleOf(id);
  return (
    <button
      type="button"
      className={classes['statusButton']}
      data-testid="open-worlds"
      title={t('command.worlds')}
      onClick={openUniverseChooser}
    >
      <IconWorld size={14} aria-hidden="true" />
      {isOwn || id === '' ? plain : title(`universe.${id}.name`, { defaultValue: plain })}
    </button>
  );
}

function ProblemCount() {
  const { t } = useTranslation('frame');
  const { errors, warnings } = countProblems(useProblems());
  const isBasic = useIsBasic();
  const Icon = errors + warnings > 0 ? IconAlertTriangle : IconCircleCheck;
  if (isBasic && errors + warnings === 0) return null;
  return (
    <button type="button" className={classes['statusButton']} onClick={() => showPanel('problems')}>
      <Icon size={14} aria-hidden="true" />
      {errors + warnings > 0
        ? [
            errors > 0 ? t('status.errors', { count: errors }) : '',
            warnings > 0 ? t('status.warnings', { count: warnings }) : '',
          ]
            .filter(Boolean)
            .join(', ')
        : t('status.noProblems')}
    </button>
  );
}

/** The action in which the present tick takes long; a click goes to its block. */
export function LongTick() {
  const { t } = useTranslation('frame');
  const isBack = useIsBack();
  const { text, node_path: path } = useSessionStore(({ waiting }) => waiting);
  const node = useSessionStore(({ tree }) => tree.find((each) => each.path === path));
  if (text === '' || isBack) return null;
  return (
    <button
      type="button"
      className={classes['statusButton']}
      data-testid="long-tick"
      disabled={!node?.node_id}
      onClick={() => node && useProjectStore.getState().reveal(node.tree_id, node.node_id)}
    >
      <IconHourglass size={14} aria-hidden="true" />
      <span role="status">{t('status.waitingFor', { place: text })}</span>
    </button>
  );
}

function Figures() {
  const past = useMoment((state) => state.shown);
  return past ? <MomentStatus moment={past} /> : <SimStatus />;
}

/** The figures of a past moment. */
function MomentStatus({ moment }: { readonly moment: Moment }) {
  const t = usePlainWords('frame');
  return (
    <span
      className={classes['sim']}
      data-testid="moment-stats"
      data-t={moment.t.toFixed(3)}
      data-tick={moment.tick}
    >
      {moment.durationMs ? (
        <Stat label={t('status.tick')} value={`${moment.durationMs.toFixed(1)} ms`} />
      ) : null}
      <Stat label={t('status.tickNumber')} value={`#${moment.tick}`} />
      <Stat label={t('status.simTime')} value={`${moment.t.toFixed(2)} s`} />
    </span>
  );
}

/** The simulation's numbers, also as data attributes for tests. */
function SimStatus() {
  const t = usePlainWords('frame');
  const sim = useSessionStore((state) => state.sim);
  const simTime = useSessionStore((state) => state.simTime);
  const speed = useMotion((motion) => motion.speed);
  const isSlow = sim !== null && !sim.paused && sim.real_time_factor < sim.speed * 0.9;
  const isOverBudget = sim !== null && sim.tick_ms > sim.tick_budget_ms;
  return (
    <span
      className={classes['sim']}
      data-testid="sim-stats"
      data-speed={speed.toFixed(3)}
      data-distance={(sim?.distance_m ?? 0).toFixed(3)}
      data-collisions={sim?.collisions ?? 0}
      data-t={simTime.toFixed(3)}
      data-rtf={(sim?.real_time_factor ?? 0).toFixed(3)}
    >
      {sim ? (
        <>
          <Stat label={t('status.speed')} value={`${speed.toFixed(2)} m/s`} />
          <Stat label={t('status.distance')} value={`${sim.distance_m.toFixed(1)} m`} />
          <Stat label={t('status.collisions')} value={String(sim.collisions)} isBad={sim.collisions > 0} />
          <Stat
            label={t('status.tick')}
            value={`${sim.tick_ms.toFixed(1)} / ${sim.tick_budget_ms.toFixed(0)} ms`}
            isBad={isOverBudget}
          />
          <Stat label={t('status.rtf')} value={`×${sim.real_time_factor.toFixed(2)}`} isBad={isSlow} />
          {sim.camera_share < 1 ? (
            <Stat label={t('status.cameras')} value={`${(sim.camera_share * 100).toFixed(0)} %`} isBad />
          ) : null}
          <Stat label={t('status.simTime')} value={`${simTime.toFixed(1)} s`} />
        </>
      ) : null}
    </span>
  );
}

interface StatProps {
  readonly label: string;
  readonly value: string;
  readonly isBad?: boolean;
}

function Stat({ label, value, isBad = false }: StatProps) {
  return (
    <Tooltip label={label}>
      <span className={classes['stat']} data-bad={isBad || undefined}>
        <span className={classes['statLabel']}>{label}</span> {value}
      </span>
    </Tooltip>
  );
}
