import { Tooltip } from '@mantine/core';
import { IconFlask2 } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { openFile } from '@/store/project/navigation';
import type { FailureAt } from '@/store/behaviourTests/failures';
import classes from './coverage.module.css';

/** The mark of a block at which a test failed, with the expected and the actual value; it leads to the test's line. */
export function FailureMark({ failures }: { readonly failures: readonly FailureAt[] }) {
  const { t } = useTranslation('behaviourTests');
  const [first] = failures;
  if (!first) return null;
  const lineOf = ({ failure, test }: FailureAt) =>
    failure.wanted === ''
      ? t('mark.told', { test, tick: failure.tick, message: failure.message })
      : t('mark.line', { test, tick: failure.tick, wanted: failure.wanted, got: failure.got });
  return (
    <Tooltip
      multiline
      maw={340}
      openDelay={100}
      label={
        <>
          <strong>{t('mark.title', { count: failures.length })}</strong>
          {failures.slice(0, 4).map((each, index) => (
            <div key={index}>{lineOf(each)}</div>
          ))}
        </>
      }
    >
      <button
        type="button"
        tabIndex={-1}
        className={`${classes['failed']} nodrag`}
        data-testid="failure-mark"
        aria-label={`${t('mark.title', { count: failures.length })} ${lineOf(first)}`}
        onClick={() => openFile(first.file, first.failure.line)}
      >
        <IconFlask2 size={13} stroke={2.4} aria-hidden="true" />
      </button>
    </Tooltip>
  );
}
