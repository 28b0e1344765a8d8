import { Button, TextInput } from '@mantine/core';
import { type SubmitEvent, useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { sendFlag, useFlags, type FlagDraft } from '@/store/moment/flags';
import classes from './axis.module.css';
import { removeFlag } from './removeFlag';
import { useFlagUser } from './useFlagUser';

const LONGEST = 1000;
const close = () => useFlags.setState({ draft: null });

/** A line above the axis in which a flag is written: Enter keeps it, Escape does not. */
export function FlagForm() {
  const draft = useFlags((state) => state.draft);
  return draft ? <Fields key={`${draft.run}/${draft.id}/${draft.t}`} draft={draft} /> : null;
}

function Fields({ draft }: { readonly draft: FlagDraft }) {
  const { t } = useTranslation('axis');
  const user = useFlagUser();
  const [text, setText] = useState(draft.text);
  const [error, setError] = useState('');
  const [isSending, setSending] = useState(false);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    field.current?.focus();
    return () => (before instanceof HTMLElement ? before.focus() : undefined);
  }, []);
  const keep = async (event: SubmitEvent) => {
    event.preventDefault();
    setSending(true);
    try {
      await sendFlag({ ...draft, text: text.trim() }, user);
      close();
    } catch (failure) {
      setError((failure as Error).message);
      setSending(false);
    }
  };
  return (
    <form
      className={classes['flagForm']}
      aria-label={t('flag.label')}
      data-testid="flag-form"
      onSubmit={(event) => void keep(event)}
    >
      <TextInput
        size="xs"
        className={classes['flagText']}
        label={t(draft.id ? 'flag.change' : 'flag.set', { t: draft.t.toFixed(2) })}
        placeholder={t('flag.example')}
        maxLength={LONGEST}
        value={text}
        error={error || null}
        onChange={({ currentTarget }) => setText(currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key !== 'Escape') return;
          event.stopPropagation();
          close();
        }}
        ref={field}
        data-testid="flag-text"
      />
      <Button
        size="compact-sm"
        type="submit"
        loading={isSending}
        disabled={text.trim() === ''}
        data-testid="flag-keep"
      >
        {t('flag.keep')}
      </Button>
      {draft.id ? (
        <Button
          size="compact-sm"
          variant="default"
          data-testid="flag-remove"
          onClick={() => {
            removeFlag(draft, user);
            close();
          }}
        >
          {t('flag.remove')}
        </Button>
      ) : null}
      <Button size="compact-sm" variant="default" onClick={close}>
        {t('flag.cancel')}
      </Button>
    </form>
  );
}
