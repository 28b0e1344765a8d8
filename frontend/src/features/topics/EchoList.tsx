import { ActionIcon, CloseButton, Tooltip } from '@mantine/core';
import {
  IconChartLine,
  IconChevronDown,
  IconChevronRight,
  IconPlayerPause,
  IconPlayerPlay,
  IconSend,
} from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { usePastTopics } from '@/store/moment/pastTopics';
import { useIsBack } from '@/store/moment/store';
import { unlisten } from '@/store/run/topics';
import { fieldsOf, type Field } from '@/store/session/fields';
import { togglePlot, useTopicsStore, type Echo } from '@/store/session/topics';
import { valueLabel } from './labels';
import { openPublish } from './publishing';
import classes from './topics.module.css';

/** The list of echoed topics, each with its last message. */
export function EchoList() {
  const echoes = useTopicsStore((state) => state.echoes);
  return Object.values(echoes).map((echo) => <EchoView key={echo.topic} echo={echo} />);
}

function EchoView({ echo: live }: { readonly echo: Echo }) {
  const { t } = useTranslation('topics');
  const [held, setHeld] = useState<Echo | null>(null);
  const isBack = useIsBack();
  const recorded = usePastTopics((state) => state.messages[live.topic]);
  const echo = isBack ? { ...live, last: recorded ?? null } : (held ?? live);
  const message = echo.last?.message;
  const [toggled, setToggled] = useState<ReadonlySet<string>>(new Set());
  const rows = useMemo(
    () => fieldsOf(message, (path) => toggled.has(path) !== isFoldedAtFirst(path)),
    [message, toggled],
  );
  const toggle = (path: string) => {
    const next = new Set(toggled);
    if (!next.delete(path)) next.add(path);
    setToggled(next);
  };
  const { topic, last } = echo;
  return (
    <section
      className={classes['echo']}
      aria-label={topic}
      data-testid={`echo-${topic}`}
      data-count={live.count}
    >
      <header className={classes['echoHead']}>
        <strong>{topic}</strong>
        <span className={classes['muted']}>
          {last
            ? t('heardAt', { time: last.t.toFixed(2), bytes: last.bytes })
            : t(isBack ? 'past.none' : 'waiting')}
        </span>
        <span className={classes['spacer']} />
        {isBack ? null : (
          <Tooltip label={t(held ? 'resume' : 'hold')}>
            <ActionIcon
              size="sm"
              aria-label={t(held ? 'resume' : 'hold')}
              onClick={() => setHeld(held ? null : live)}
            >
              {held ? <IconPlayerPlay size={14} /> : <IconPlayerPause size={14} />}
            </ActionIcon>
          </Tooltip>
        )}
        {last && !isBack ? (
          <Tooltip label={t('publishOne')}>
            <ActionIcon size="sm" aria-label={t('publishOne')} onClick={() => openPublish(topic, last.type)}>
              <IconSend size={14} />
            </ActionIcon>
          </Tooltip>
        ) : null}
        <CloseButton
          size="sm"
          aria-label={t(isBack ? 'past.hide' : 'unlisten', { topic })}
          onClick={() => unlisten(topic)}
        />
      </header>
      <div className={classes['fields']}>
        {rows.map((field) => (
          <FieldRow
            key={field.path}
            topic={topic}
            field={field}
            length={last?.cut?.[field.path]}
            isFolded={toggled.has(field.path) !== isFoldedAtFirst(field.path)}
            onToggle={toggle}
          />
        ))}
      </div>
    </section>
  );
}

/** Returns whether a field is folded at first: headers, covariances and long lists are rarely needed. */
function isFoldedAtFirst(path: string): boolean {
  return /(^|\.)(header|covariance|ranges|intensities|data)$/.test(path);
}

interface FieldRowProps {
  readonly topic: string;
  readonly field: Field;
  /** The real length of a list or text that was shortened. */
  readonly length: number | undefined;
  readonly isFolded: boolean;
  readonly onToggle: (path: string) => void;
}

function FieldRow({ topic, field, length, isFolded, onToggle }: FieldRowProps) {
  const { t } = useTranslation('topics');
  const { path, name, value, depth, isParent } = field;
  const isPlotted = useTopicsStore((state) =>
    state.plotted.some((plotted) => plotted.topic === topic && plotted.path === path),
  );
  const isPlottable = typeof value === 'number' || typeof value === 'boolean';
  const count = Array.isArray(value) ? t('items', { count: length ?? value.length }) : '';
  return (
    <div className={classes['field']} style={{ paddingLeft: 8 + depth * 14 }} data-path={path}>
      {isParent ? (
        <button
          type="button"
          className={classes['fold']}
          aria-expanded={!isFolded}
          onClick={() => onToggle(path)}
        >
          {isFolded ? <IconChevronRight size={12} /> : <IconChevronDown size={12} />}
          {name} <span className={classes['muted']}>{count}</span>
        </button>
      ) : (
        <>
          <span className={classes['fieldName']}>{name}</span>
          <span className={classes['fieldValue']}>
            {valueLabel(value)}
            {length ? <span className={classes['muted']}> {t('cutText', { count: length })}</span> : null}
          </span>
          {isPlottable ? (
            <ActionIcon
              size="xs"
              className={classes['plotButton']}
              variant={isPlotted ? 'light' : 'subtle'}
              color={isPlotted ? 'indigo' : 'gray'}
              aria-pressed={isPlotted}
              aria-label={t('plot', { path })}
              title={t('plot', { path })}
              onClick={() => togglePlot(topic, path)}
            >
              <IconChartLine size={13} />
            </ActionIcon>
          ) : null}
        </>
      )}
    </div>
  );
}
