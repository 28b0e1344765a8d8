import { ActionIcon } from '@mantine/core';
import { IconPencil, IconTrash, IconX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { canFlag, editFlag, useFlags } from '@/store/moment/flags';
import { lookAtMark } from '@/store/moment/lookAtMark';
import type { Extent } from '@/store/moment/looking';
import { useMoment } from '@/store/moment/store';
import type { Mark } from '@/store/recording/types';
import { useSessionStore } from '@/store/session/store';
import classes from './axis.module.css';
import { MARK_ICONS } from './markIcons';
import { useMarks } from './marks';
import { adviceOf, labelOf } from './markTexts';
import { removeFlag } from './removeFlag';
import { useFlagUser } from './useFlagUser';

/** The list of all marks of the run: each goes to its moment, and the user's own are changed and removed. */
export function Marks({ extent }: { readonly extent: Extent }) {
  const { t } = useTranslation('axis');
  const isListed = useFlags((state) => state.isListed);
  const marks = useMarks(extent.run, extent.from);
  if (!isListed) return null;
  return (
    <section className={classes['changes']} aria-label={t('marks.label')} data-testid="axis-marks">
      <header className={classes['changesHead']}>
        <strong>{t('marks.title')}</strong>
        <ActionIcon
          size="sm"
          aria-label={t('marks.close')}
          onClick={() => useFlags.setState({ isListed: false })}
        >
          <IconX size={14} />
        </ActionIcon>
      </header>
      {marks.length === 0 ? <p className={classes['changesNote']}>{t('marks.none')}</p> : null}
      <ul className={classes['changesList']}>
        {marks.map((mark) => (
          <MarkLine key={`${mark.kind}${mark.id ?? ''}${mark.t}${mark.text}`} mark={mark} run={extent.run} />
        ))}
      </ul>
    </section>
  );
}

function MarkLine({ mark, run }: { readonly mark: Mark; readonly run: string }) {
  const { t } = useTranslation('axis');
  const user = useFlagUser();
  const isShown = useMoment((state) => state.t === mark.t);
  const canChange = useSessionStore(canFlag);
  const Icon = MARK_ICONS[mark.kind];
  const { id, text } = mark;
  const advice = adviceOf(t, mark);
  return (
    <li className={classes['markLine']} data-kind={mark.kind} data-testid="mark-line">
      <button
        type="button"
        className={classes['change']}
        aria-current={isShown || undefined}
        onClick={() => lookAtMark(mark)}
      >
        <Icon size={12} aria-hidden="true" className={classes['markIcon']} data-kind={mark.kind} />
        {labelOf(t, mark)}
        {advice ? <span className={classes['advice']}>{advice}</span> : null}
      </button>
      {id !== undefined && canChange ? (
        <>
          <ActionIcon
            size={24}
            aria-label={t('flag.changeNamed', { text })}
            data-testid="mark-edit"
            onClick={() => editFlag(mark)}
          >
            <IconPencil size={14} />
          </ActionIcon>
          <ActionIcon
            size={24}
            aria-label={t('flag.removeNamed', { text })}
            data-testid="mark-remove"
            onClick={() => removeFlag({ run, id, t: mark.t, text }, user)}
          >
            <IconTrash size={14} />
          </ActionIcon>
        </>
      ) : null}
    </li>
  );
}
