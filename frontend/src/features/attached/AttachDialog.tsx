import { Button, Group, Modal, Text, TextInput } from '@mantine/core';
import { useMutation } from '@tanstack/react-query';
import { useEffect, useState, type SyntheticEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { reasonOf } from '@/api/reason';
import { openBegun } from '@/store/route/begun';

const KEY = 'bts.attach.address';

interface Props {
  readonly isOpen: boolean;
  /** Loads the page of the session in advance, while the user writes the address. */
  readonly onOpen?: (() => Promise<unknown>) | undefined;
  readonly onClose: () => void;
}

/** The dialogue that asks for the address of a program to follow. */
export function AttachDialog({ isOpen, onOpen, onClose }: Props) {
  const { t } = useTranslation('attached');
  const [address, setAddress] = useState(() => localStorage.getItem(KEY) ?? '');
  const [isEmpty, setEmpty] = useState(false);
  const { mutate, isPending, error, reset } = useMutation({
    mutationFn: api.attach,
    onSuccess: (session, wanted) => {
      localStorage.setItem(KEY, wanted);
      onClose();
      openBegun(session);
    },
  });
  useEffect(() => {
    // Without them, page and processes start when they are needed, and say then what is wrong.
    if (!isOpen) return;
    onOpen?.().catch(() => undefined);
    api.prepareAttach().catch(() => undefined);
  }, [isOpen, onOpen]);
  const submit = (event: SyntheticEvent) => {
    event.preventDefault();
    const wanted = address.trim();
    setEmpty(wanted === '');
    if (wanted !== '') mutate(wanted);
  };
  return (
    <Modal opened={isOpen} onClose={onClose} title={t('dialog.title')}>
      <form onSubmit={submit} noValidate>
        <Text size="sm" mb="md">
          {t('dialog.text')}
        </Text>
        <TextInput
          label={t('dialog.address')}
          description={t('dialog.addressHint')}
          placeholder={t('dialog.example')}
          value={address}
          autoComplete="off"
          spellCheck={false}
          data-autofocus
          data-testid="attach-address"
          error={isEmpty ? t('dialog.empty') : error ? reasonOf(error) : null}
          onChange={({ currentTarget }) => {
            setAddress(currentTarget.value);
            setEmpty(false);
            reset();
          }}
        />
        <Group justify="end" mt="lg">
          <Button variant="default" onClick={onClose}>
            {t('dialog.cancel')}
          </Button>
          <Button type="submit" loading={isPending} data-testid="attach-accept">
            {t('dialog.accept')}
          </Button>
        </Group>
      </form>
    </Modal>
  );
}
