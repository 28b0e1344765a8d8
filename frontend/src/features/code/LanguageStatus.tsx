import { Button, Checkbox } from '@mantine/core';
import type { TFunction } from 'i18next';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useLanguageStore, type LanguageState } from '@/store/language';
import { waitingText } from './language/absence';
import { retryLanguage } from './language/client';
import { formatsOnSave, setFormatsOnSave } from './language/ruff';
import classes from './code.module.css';
import frame from './editorFrame.module.css';

/** The state of the language server, below a Python editor, with advice if it does not run. */
export function LanguageStatus({ path }: { readonly path: string }) {
  const { t } = useTranslation('code');
  const state = useLanguageStore((store) => store.state);
  const [formats, setFormats] = useState(formatsOnSave);
  return (
    <div className={frame['bar']} data-state={state.kind} data-testid="language-state" data-path={path}>
      <span className={classes['languageText']} role="status">
        {textOf(state, t)}
      </span>
      {state.kind === 'failed' && !state.willRetry ? (
        <Button size="compact-xs" variant="light" onClick={retryLanguage}>
          {t('language.retry')}
        </Button>
      ) : null}
      <Checkbox
        size="xs"
        label={t('language.formatOnSave')}
        checked={formats}
        onChange={(event) => {
          setFormatsOnSave(event.currentTarget.checked);
          setFormats(event.currentTarget.checked);
        }}
      />
    </div>
  );
}

function textOf(state: LanguageState, t: TFunction<'code'>): string {
  if (state.kind === 'waiting') return waitingText(state);
  if (state.kind !== 'failed') return t(`language.${state.kind}`);
  const text = t('language.failed', { reason: state.reason || t('language.lost') });
  return state.willRetry ? `${text} ${t('language.retrying')}` : text;
}
