import { Button, TextInput } from '@mantine/core';
import { type SubmitEvent, useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Branch } from '@/generated/messages';
import { dropBranch, nameBranch, useBranchForm } from '@/store/dialogs/branches';
import { useSessionStore } from '@/store/session/store';
import classes from '../axis.module.css';

const LONGEST = 80;
const close = () => useBranchForm.setState({ run: null });

/** A line above the axis in which a branch gets a name, or is thrown away. */
export function BranchForm() {
  const run = useBranchForm((state) => state.run);
  const branch = useSessionStore(({ branches }) => branches.find((each) => each.run === run));
  return branch ? <Fields key={branch.run} branch={branch} /> : null;
}

function Fields({ branch }: { readonly branch: Branch }) {
  const { t } = useTranslation('axis');
  const [name, setName] = useState(branch.name);
  const [error, setError] = useState('');
  const [isSure, setSure] = useState(false);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    field.current?.focus();
    return () => (before instanceof HTMLElement ? before.focus() : undefined);
  }, []);
  const does = async (doing: Promise<void>) => {
    try {
      await doing;
      close();
    } catch (failure) {
      setError((failure as Error).message);
      setSure(false);
    }
  };
  const keep = (event: SubmitEvent) => {
    event.preventDefault();
    void does(nameBranch(branch.run, name));
  };
  return (
    <form
      className={classes['flagForm']}
      aria-label={t('branch.label')}
      data-testid="branch-form"
      onSubmit={keep}
    >
      <TextInput
        size="xs"
        className={classes['flagText']}
        label={t('branch.name', { t: branch.from_t.toFixed(2) })}
        placeholder={t('branch.example')}
        maxLength={LONGEST}
        value={name}
        error={error || null}
        onChange={({ currentTarget }) => setName(currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key !== 'Escape') return;
          event.stopPropagation();
          close();
        }}
        ref={field}
        data-testid="branch-name"
      />
      <Button size="compact-sm" type="submit" data-testid="branch-keep">
        {t('branch.keep')}
      </Button>
      <Button
        size="compact-sm"
        variant={isSure ? 'filled' : 'default'}
        color="red"
        data-testid="branch-drop"
        onClick={() => (isSure ? void does(dropBranch(branch.run)) : setSure(true))}
      >
        {t(isSure ? 'branch.dropSure' : 'branch.drop')}
      </Button>
      <Button size="compact-sm" variant="default" onClick={close}>
        {t('flag.cancel')}
      </Button>
    </form>
  );
}
