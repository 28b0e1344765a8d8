import { Button, Group, Loader, Modal, Text, TextInput } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { isPythonName } from '@/model/pythonNames';
import { leaveRename, rename, useRename, type RenameRequest } from '../language/rename';
import { PlaceText } from './PlaceText';
import classes from './places.module.css';
import { usePlacesText } from './usePlacesText';

/** Asks for the new name of a symbol of the file with this URI; shows each line that changes. */
export function RenameDialog({ uri }: { readonly uri: string }) {
  const request = useRename((state) => (state.request?.uri === uri ? state.request : null));
  const { t } = useTranslation('code');
  return (
    <Modal
      opened={request !== null}
      onClose={leaveRename}
      title={t('rename.title', { name: request?.before ?? '' })}
      size="lg"
      returnFocus={false}
    >
      {request ? <Form key={`${request.at} ${request.before}`} request={request} /> : null}
    </Modal>
  );
}

function Form({ request }: { readonly request: RenameRequest }) {
  const { t } = useTranslation('code');
  const summary = usePlacesText();
  const { before, groups } = request;
  const [name, setName] = useState(before);
  const after = name.trim();
  const isName = isPythonName(after);
  const submit = () => {
    if (!isName) return;
    leaveRename();
    if (after !== before) void rename(request, after);
  };
  return (
    <form
      data-testid="rename-dialog"
      onSubmit={(event) => {
        event.preventDefault();
        submit();
      }}
    >
      <TextInput
        data-autofocus
        label={t('rename.label', { name: before })}
        value={name}
        spellCheck={false}
        autoComplete="off"
        error={isName || after === '' ? undefined : t('rename.noName', { name: after })}
        onFocus={(event) => event.currentTarget.select()}
        onChange={(event) => setName(event.currentTarget.value)}
      />
      <div className={classes['summary']} role="status">
        {groups === null ? (
          <Group gap={8}>
            <Loader size={14} role="none" />
            {t('rename.looking')}
          </Group>
        ) : (
          summary(groups)
        )}
      </div>
      {groups === null ? null : (
        // A region that scrolls has to be reachable by keyboard.
        // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
        <div className={classes['preview']} role="region" aria-label={t('rename.preview')} tabIndex={0}>
          {groups.map((group) => (
            <div key={group.uri}>
              <div className={classes['file']}>
                {group.name} <span className={classes['outside']}>{group.places.length}</span>
              </div>
              {group.places.map((place) => (
                <div
                  key={`${place.line}:${place.from}`}
                  className={`${classes['place'] ?? ''} ${classes['still'] ?? ''}`}
                >
                  <PlaceText place={place} {...(isName && after !== before ? { after } : {})} />
                </div>
              ))}
            </div>
          ))}
        </div>
      )}
      <Text size="xs" c="dimmed" mt={8}>
        {t('rename.hint')}
      </Text>
      <Group justify="flex-end" mt="md">
        <Button variant="default" onClick={leaveRename}>
          {t('dialog.cancel')}
        </Button>
        <Button type="submit" disabled={!isName || groups === null}>
          {t('rename.submit')}
        </Button>
      </Group>
    </form>
  );
}
